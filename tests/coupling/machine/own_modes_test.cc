#include "coupling/machine/own_mode_base.h"

#include "coupling/algebra/dense_modes.h"
#include "coupling/integration/bdf/bdf.h"
#include "coupling/machine/dense_base.h"
#include "coupling/machine/machine.h"
#include "tests/support/test.h"

namespace gestell
{
namespace
{

using coupling::OwnModes;
using coupling::ReducedFrame;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int n1 = 6, m = 80, n = n1 + m; // up to 14 dampers are cheap

/// In Craig-Bampton coordinates, with another damping ratio in each of its first own modes, and dampers between points
/// that move with all coordinates.
ReducedFrame frame_with_modal_damping(int n_damped = n, bool floats = false, int n_dampers = 0)
{
  std::srand(5);
  const auto   square = [](const MatrixXd &A) -> MatrixXd { return A * A.transpose(); };
  ReducedFrame frame;
  frame.n_interface = n1;
  frame.interfaces  = {{"top", {}, {0, 1, 2, 3, 4, 5}, {1., 1., 1., 1., 1., 1.}}};
  frame.omega0      = VectorXd::LinSpaced(m, 200., 20000.);
  const MatrixXd G  = (1e3 * frame.omega0.cwiseInverse()).asDiagonal() * MatrixXd::Random(m, n1);
  frame.M           = MatrixXd::Identity(n, n);
  frame.M.topLeftCorner(n1, n1) =
      G.transpose() * G + square(MatrixXd::Random(n1, n1)) + 0.1 * MatrixXd::Identity(n1, n1);
  frame.M.bottomLeftCorner(m, n1) = G;
  frame.M.topRightCorner(n1, m)   = G.transpose();
  frame.C                         = MatrixXd::Zero(n, n);
  frame.C.topLeftCorner(n1, n1)   = 1e7 * (square(MatrixXd::Random(n1, n1)) + 0.1 * MatrixXd::Identity(n1, n1));
  frame.C.bottomRightCorner(m, m) = frame.omega0.cwiseAbs2().asDiagonal();
  if (floats)
    frame.C.topLeftCorner(n1, n1).setZero();
  const auto     own   = coupling::dense_modes(frame.C, frame.M, coupling::cancelled_by_reduction, floats ? n1 : 0);
  const MatrixXd Z     = frame.M * own.V;
  VectorXd       ratio = VectorXd::LinSpaced(n, 0.02, 0.1);
  ratio.tail(n - n_damped).setZero();
  frame.B = Z * ratio.cwiseProduct(own.omega).asDiagonal() * Z.transpose();
  for (int i = 0; i < n_dampers; ++i)
  {
    const VectorXd g = 10. * VectorXd::Random(n);
    frame.B += g * g.transpose();
  }
  frame.frequencies_hz    = own.omega / (2. * M_PI);
  frame.translations_load = MatrixXd::Random(n, 3);
  return frame;
}

TEST(OwnModes, AreOtherCoordinatesOfTheSameFrame)
{
  const ReducedFrame frame  = frame_with_modal_damping();
  ReducedFrame       turned = frame;
  ASSERT_TRUE(coupling::turn_to_own_modes(turned));
  // Receptance of the interface, and its motion under weight.
  const std::complex<double> s(0., 300.);
  const auto                 answer = [&](const ReducedFrame &of) -> Eigen::MatrixXcd
  {
    Eigen::MatrixXcd load = Eigen::MatrixXcd::Zero(n, n1 + 3);
    load.topLeftCorner(n1, n1).setIdentity();
    load.rightCols(3) = of.translations_load.cast<std::complex<double>>();
    return ((s * s * of.M + s * of.B + of.C).lu().solve(load)).topRows(n1);
  };
  const Eigen::MatrixXcd expected = answer(frame);
  EXPECT_LT((answer(turned) - expected).norm(), 1e-10 * expected.norm());
  ReducedFrame twice = turned;
  ASSERT_TRUE(coupling::turn_to_own_modes(twice));
  EXPECT_LT((twice.M - turned.M).norm(), 1e-9 * turned.M.norm());
  EXPECT_LT((twice.C - turned.C).norm(), 1e-9 * turned.C.norm());
}

TEST(OwnModes, AreLedBackToThoseOfTheFixedInterface)
{
  const ReducedFrame frame  = frame_with_modal_damping();
  ReducedFrame       turned = frame;
  EXPECT_EQ(coupling::fixed_mode_coordinates(frame).T.size(), 0);
  ASSERT_TRUE(coupling::turn_to_own_modes(turned));
  const auto fixed = coupling::fixed_mode_coordinates(turned);
  EXPECT_LT((fixed.omega - frame.omega0).cwiseAbs().maxCoeff(), 1e-8 * frame.omega0.maxCoeff());
  EXPECT_LT((fixed.T * fixed.inverse - MatrixXd::Identity(n, n)).norm(), 1e-8);
  const MatrixXd C = fixed.T.transpose() * turned.C * fixed.T;
  EXPECT_LT((C - frame.C).norm(), 1e-8 * frame.C.norm());
}

TEST(OwnModes, MayBeFreeOrUndampedOrHaveAFewDampersBetweenThem)
{
  for (ReducedFrame frame : {frame_with_modal_damping(20), frame_with_modal_damping(n, true),
                             frame_with_modal_damping(n, false, 3), frame_with_modal_damping(n, true, 6)})
  {
    const std::optional<OwnModes> modes = coupling::turn_to_own_modes(frame);
    ASSERT_TRUE(modes);
    const auto n_a            = modes->R.rows();
    MatrixXd   B              = MatrixXd::Zero(n, n); // of the modes, in the turned coordinates
    const auto a              = modes->damping.head(n_a).asDiagonal();
    B.topLeftCorner(n1, n1)   = modes->S.transpose() * a * modes->S;
    B.topRightCorner(n1, m)   = -modes->S.transpose() * a * modes->R;
    B.bottomLeftCorner(m, n1) = B.topRightCorner(n1, m).transpose();
    B.bottomRightCorner(m, m) = modes->R.transpose() * a * modes->R;
    B.bottomRightCorner(m, m).diagonal() += modes->damping.tail(m);
    EXPECT_LT((B - frame.B).norm(), 1e-10 * frame.B.norm());
  }
}

TEST(OwnModes, HaveAsManyDampersAsTheFrame)
{
  for (const int dampers : {0, 1, 3, 6})
  {
    ReducedFrame frame = frame_with_modal_damping(n, false, dampers);
    EXPECT_EQ(coupling::turn_to_own_modes(frame)->R.rows(), n1 + dampers);
  }
  ReducedFrame rayleigh = frame_with_modal_damping(n);
  rayleigh.B            = 3. * rayleigh.M + 1e-5 * rayleigh.C;
  const VectorXd g      = VectorXd::Random(n);
  rayleigh.B += g * g.transpose();
  EXPECT_EQ(coupling::turn_to_own_modes(rayleigh)->R.rows(), n1 + 1);
}

TEST(OwnModes, AreLeftAloneWhereDampersAreManyOrStepsAreCheapAnyway)
{
  ReducedFrame damped = frame_with_modal_damping(n, false, 15);
  EXPECT_FALSE(coupling::turn_to_own_modes(damped));
  ReducedFrame rayleigh = frame_with_modal_damping();
  rayleigh.B            = 3. * rayleigh.M + 1e-5 * rayleigh.C;
  EXPECT_FALSE(coupling::turn_to_own_modes(rayleigh));
}

/// A body on a spring at the interface, and more inertia there.
MatrixXd with_body(const MatrixXd &frame, double own, double between)
{
  MatrixXd whole            = MatrixXd::Zero(n + 1, n + 1);
  whole.topLeftCorner(n, n) = frame;
  whole(0, 0) += own + between;
  whole(n, n) = own + between;
  whole(0, n) = whole(n, 0) = -between;
  return whole;
}

void expect_products_and_solutions(ReducedFrame frame)
{
  const std::optional<OwnModes> modes = coupling::turn_to_own_modes(frame);
  ASSERT_TRUE(modes);
  const MatrixXd M = with_body(frame.M, 2., 0.), B = with_body(frame.B, 10., 5.), C = with_body(frame.C, 0., 1e6);
  const coupling::OwnModeBase base(M, B, C, *modes, std::make_unique<coupling::DenseBase>(M, B, C));
  const VectorXd              x = VectorXd::Random(n + 1), f = 1e-3 * VectorXd::Random(n + 1);
  VectorXd                    y(n + 1);
  base.mass_times(x, y);
  EXPECT_LT((y - M * x).norm(), 1e-12 * (M * x).norm());
  base.damping_times(x, y);
  EXPECT_LT((y - B * x).norm(), 1e-12 * (B * x).norm());
  base.stiffness_times(x, y);
  EXPECT_LT((y - C * x).norm(), 1e-12 * (C * x).norm());

  const double h_beta = 1e-5;
  for (const std::array<double, 3> &w : {std::array{1., h_beta, h_beta * h_beta}, std::array{1., 0., 0.},
                                         std::array{1., 0., h_beta * h_beta}, std::array{1., -h_beta, 1e-10}})
  {
    const auto     solver = base.factorise(w[0], w[1], w[2]);
    const MatrixXd A      = w[0] * M + w[1] * B + w[2] * C;
    const VectorXd whole = A.ldlt().solve(f), step = A.ldlt().solve(M * x + f);
    solver->solve(f, y);
    EXPECT_LT((y - whole).norm(), 1e-12 * whole.norm());
    if (solver->leading().empty())
      continue;
    solver->solve_leading(x, f, y);
    solver->solve_following(x, f, y);
    EXPECT_LT((y - step).norm(), 1e-12 * step.norm());
  }
}

TEST(OwnModes, MultiplyAndSolveAsTheMatricesDo)
{
  for (const bool floats : {false, true})
    for (const int dampers : {0, 1, 14})
      expect_products_and_solutions(frame_with_modal_damping(n, floats, dampers));
}

TEST(OwnModes, DoNotChangeTheMotionOfTheInterface)
{
  const auto run = [](bool modal)
  {
    ReducedFrame frame = frame_with_modal_damping(n, false, 4);
    frame.modal        = modal; // false: its coordinates stay
    coupling::MachineModel model;
    model.set_frame(frame);
    const coupling::Machine machine(std::move(model));
    coupling::Bdf::Options  options;
    options.step = 1e-4;
    coupling::Bdf bdf(machine, options);
    VectorXd      v = VectorXd::Zero(n);
    v[0]            = 1.;
    // The same motion: internal displacements of both are zero, velocities follow the interface.
    const MatrixXd &M = machine.model().reduced_frame()->M;
    EXPECT_EQ(M.isApprox(frame.M, 1e-3), !modal); // turned, or not
    MatrixXd whole_M, B, C;
    EXPECT_TRUE(machine.linear().dense_matrices(whole_M, B, C)); // for integrators in modes
    EXPECT_EQ((whole_M - M).norm(), 0.);
    v.tail(m) = -M.bottomRightCorner(m, m).ldlt().solve(M.bottomLeftCorner(m, n1) * v.head(n1));
    bdf.begin(0., VectorXd::Zero(n), v);
    for (int i = 0; i < 100; ++i)
      bdf.advance();
    return VectorXd(bdf.instant().q.head(n1));
  };
  const VectorXd expected = run(false);
  EXPECT_LT((run(true) - expected).norm(), 1e-9 * expected.norm());
}

} // namespace
} // namespace gestell
