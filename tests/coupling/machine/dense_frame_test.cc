// A small frame given by matrices, as the machine gets it.

#include "coupling/reduction/dense_frame.h"
#include "tests/support/test.h"

#include <Eigen/Eigenvalues>

namespace
{

using namespace gestell;

/// Three masses in a row on a foundation; the last is the interface, counted downwards.
fem::FrameMatrices chain(double ratio)
{
  Eigen::Matrix3d C;
  C << 5e6, -3e6, 0., -3e6, 5e6, -2e6, 0., -2e6, 2e6;
  fem::FrameMatrices frame;
  frame.M                   = Eigen::MatrixXd(Eigen::Vector3d(100., 200., 300.).asDiagonal()).sparseView();
  frame.C                   = Eigen::MatrixXd(C).sparseView();
  frame.B                   = Eigen::SparseMatrix<double>(3, 3);
  frame.modal_damping_ratio = ratio;
  frame.translations        = Eigen::MatrixXd::Zero(3, 3);
  frame.translations.col(2).setConstant(-1.);
  fem::Interface top;
  top.name                 = "top";
  top.coordinate[fem::uz]  = 2;
  top.sign[fem::uz]        = -1.;
  frame.interfaces         = {top};
  const Eigen::Vector3d on = Eigen::Vector3d(2e6, 0., 0.);
  frame.outputs            = {{"support.ground", "N", on, Eigen::VectorXd::Zero(3)}};
  return frame;
}

TEST(DenseFrame, PutsInterfaceRowsFirstAndChangesNothingElse)
{
  const auto frame = chain(0.);
  const auto dense = coupling::dense_frame(frame);
  EXPECT_EQ(dense.n_interface, 1);
  EXPECT_EQ(dense.interfaces[0].coordinate[fem::uz], 0); // was row 3
  EXPECT_EQ(dense.interfaces[0].coordinate[fem::ux], -1);
  EXPECT_DOUBLE_EQ(dense.M(0, 0), 300.);
  EXPECT_DOUBLE_EQ(dense.outputs[0].on_q[1], 2e6); // row 1 follows the interface
  EXPECT_DOUBLE_EQ(dense.translations_load(0, 2), -300.);

  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(frame.C, frame.M);
  for (int i = 0; i < 3; ++i) // a permutation keeps the spectrum, up to round-off of the solver
    EXPECT_NEAR(std::pow(2. * M_PI * dense.frequencies_hz[i], 2), modes.eigenvalues()[i],
                1e-12 * modes.eigenvalues()[2]);
}

TEST(DenseFrame, ModalDampingGivesEveryModeItsRatio)
{
  const double                                                    zeta  = 0.03;
  const auto                                                      dense = coupling::dense_frame(chain(zeta));
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(dense.C, dense.M);
  const Eigen::MatrixXd delta = modes.eigenvectors().transpose() * dense.B * modes.eigenvectors();
  const Eigen::MatrixXd exact = (2. * zeta * modes.eigenvalues().cwiseSqrt()).asDiagonal();
  EXPECT_LT((delta - exact).norm(), 1e-12 * exact.norm()); // Phi^T B Phi = diag(2 zeta omega)
}

TEST(DenseFrame, RefusesAStiffnessThatPushesItselfAway)
{
  auto frame = chain(0.);
  frame.C    = -frame.C;
  EXPECT_THROW(coupling::dense_frame(frame), std::invalid_argument);
}

TEST(DenseFrame, RecognisesModesBehindTheInterface)
{
  auto frame = chain(0.);
  EXPECT_FALSE(coupling::dense_frame(frame).modal);

  Eigen::Matrix3d M, C;
  M << 1., 0., 0.7, 0., 1., -0.2, 0.7, -0.2, 300.; // the interface is row 3
  C                = Eigen::Vector3d(4e4, 9e4, 2e6).asDiagonal();
  frame.M          = M.sparseView();
  frame.C          = C.sparseView();
  const auto modal = coupling::dense_frame(frame);
  ASSERT_TRUE(modal.modal);
  EXPECT_EQ(modal.omega0, Eigen::Vector2d(200., 300.));

  for (const auto &[i, j] : {std::pair(0, 1), std::pair(1, 2)}) // stiffness between modes, or to the interface
  {
    auto coupled             = frame;
    coupled.C.coeffRef(i, j) = coupled.C.coeffRef(j, i) = 1.;
    EXPECT_FALSE(coupling::dense_frame(coupled).modal);
  }
  frame.M.coeffRef(0, 0) = 2.;
  EXPECT_FALSE(coupling::dense_frame(frame).modal);
}

TEST(UnitTranslations, GiveTheLoadAgainWhereACoordinateHasNoMass)
{
  for (const double mass : {3., 0.})
  {
    coupling::ReducedFrame frame;
    frame.M                 = Eigen::Vector3d(2., mass, 5.).asDiagonal();
    frame.translations_load = frame.M * Eigen::Matrix3d::Random();
    const auto R            = coupling::unit_translations(frame);
    EXPECT_LT((frame.M * R - frame.translations_load).norm(), 1e-14) << mass;
  }
}

} // namespace
