// The number of modes of a frame from CAD, against its full matrices.

#include "coupling/reduction/reduce_frame.h"
#include "fem/mesh/mesher.h"
#include "fem/recovery/discretisation.h"
#include "fem/values/two_pi.h"
#include "tests/support/cad_samples.h"
#include "tests/support/test.h"

#include <Eigen/LU>
#include <Eigen/UmfPackSupport>

namespace gestell
{
namespace
{

using Complex = std::complex<double>;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using ComplexMatrix = Eigen::SparseMatrix<Complex>;

constexpr double zeta = 0.01; // zeta: what the estimate takes where the frame has none

/// The press of meshes/ on its foundation, of coarse tetrahedra: 19000 coordinates.
fem::FrameMatrices press()
{
  auto s     = fem::test::specification(fem::test::press_frame(), 0.5);
  s.material = {2.1e11, 0.3, 7850., "", "steel"};
  s.surfaces = {{"front", fem::test::cylinder({0., 1., 0.}, {0., -0.52, 2.56}, 0.12)},
                {"rear", fem::test::cylinder({0., 1., 0.}, {0., 0.52, 2.56}, 0.12)},
                {"left", fem::test::plane({1., 0., 0.}, {-0.48, 0., 1.78}, 2)},
                {"right", fem::test::plane({-1., 0., 0.}, {0.48, 0., 1.78}, 2)},
                {"table", fem::test::plane({0., 0., 1.}, {0., 0., 0.9}, 3)},
                {"feet", fem::test::plane({0., 0., -1.}, {0., 0., 0.}, 4)}};
  fem::Support feet;
  feet.name      = "feet";
  feet.surfaces  = {"feet"};
  feet.kind      = fem::SupportKind::foundation;
  feet.stiffness = {2e8, 2e8, 4e8};
  feet.damping   = {2e5, 2e5, 4e5}; // at 386 Hz 2.4 times the stiffness
  s.supports     = {feet};
  s.interfaces   = {{"crown", {"front", "rear"}, fem::InterfaceCoupling::rigid, {}, ""},
                    {"guides", {"left", "right"}, fem::InterfaceCoupling::average, {}, ""},
                    {"table", {"table"}, fem::InterfaceCoupling::average, {}, ""}};
  return fem::discretise(fem::make_mesh(s), s);
}

/// H of the interface [n1 x n1] at some frequencies, by one complex factor each.
using Receptances = std::vector<MatrixXcd>;

/// C (1 + 2 i zeta) - omega^2 M + i omega B
template <typename Out, typename Matrix>
Out dynamic_stiffness(const Matrix &M, const Matrix &B, const Matrix &C, double omega)
{
  return Complex(1., 2. * zeta) * C.template cast<Complex>() - omega * omega * M.template cast<Complex>() +
         Complex(0., omega) * B.template cast<Complex>();
}

Receptances full(const fem::FrameMatrices &frame, const std::vector<double> &omegas)
{
  const auto q1   = frame.interface_coordinates();
  MatrixXcd  unit = MatrixXcd::Zero(frame.M.rows(), Eigen::Index(q1.size()));
  for (std::size_t i = 0; i < q1.size(); ++i)
    unit(q1[i], Eigen::Index(i)) = 1.;
  Receptances                     result;
  Eigen::UmfPackLU<ComplexMatrix> factor;
  factor.umfpackControl()(UMFPACK_IRSTEP) = 0; // 1e-9 will do
  for (const double omega : omegas)
  {
    const auto D = dynamic_stiffness<ComplexMatrix>(frame.M, frame.B, frame.C, omega);
    factor.compute(D);
    result.push_back(MatrixXcd(factor.solve(unit))(q1, Eigen::all));
  }
  return result;
}

Receptances reduced(const coupling::ReducedFrame &frame, const std::vector<double> &omegas)
{
  Receptances result;
  for (const double omega : omegas)
    result.push_back(dynamic_stiffness<MatrixXcd>(frame.M, frame.B, frame.C, omega)
                         .partialPivLu()
                         .inverse()
                         .topLeftCorner(frame.n_interface, frame.n_interface));
  return result;
}

class FrameFromCad : public ::testing::Test
{
protected:
  FrameFromCad()
  {
    coupling::ReductionOptions options;
    options.n_modes          = 60;
    const auto     many      = reduce_frame(frame, options);
    const VectorXd resonance = many.frequencies_hz;
    highest_hz               = 0.5 * (resonance(last) + resonance(last + 1));
    for (int j = 0; j <= last; j += 2)
      omegas.push_back(two_pi * resonance(j));
    for (int i = 1; i <= 2; ++i)
      omegas.push_back(two_pi * highest_hz * i / 2.);
    exact = full(frame, omegas);
    scale = many.M.diagonal().head(many.n_interface).cwiseSqrt();
  }

  coupling::ReducedFrame with(int n_modes, double tolerance = 0.01) const
  {
    coupling::ReductionOptions options;
    options.n_modes   = n_modes;
    options.tolerance = tolerance;
    options.frequency = highest_hz;
    return reduce_frame(frame, options);
  }

  /// Largest |H - H_full| / |H_full|, coordinates scaled by their own inertia.
  double error(const coupling::ReducedFrame &model) const
  {
    const auto H       = reduced(model, omegas);
    double     largest = 0.;
    for (std::size_t i = 0; i < H.size(); ++i)
      largest = std::max(largest, (scale.asDiagonal() * (H[i] - exact[i]) * scale.asDiagonal()).norm() /
                                      (scale.asDiagonal() * exact[i] * scale.asDiagonal()).norm());
    return largest;
  }

  static constexpr int last = 14; // mode within the range

  fem::FrameMatrices  frame      = press();
  double              highest_hz = 0.;
  std::vector<double> omegas;
  Receptances         exact;
  VectorXd            scale;
};

TEST_F(FrameFromCad, HasTheReceptanceOfItsFullMatricesWithinTheToleranceByHardlyMoreModesThanNeeded)
{
  for (const double tolerance : {0.05, 0.01, 0.001})
  {
    const auto model = with(-1, tolerance);
    const int  m = int(model.omega0.size()), few = (2 * m - 1) / 3; // 1.5 times as many are less than m
    ASSERT_FALSE(model.statements.empty());
    std::cout << "tolerance " << tolerance << ", error " << error(model) << "; " << model.statements[0] << "\n";
    EXPECT_LE(error(model), tolerance);
    EXPECT_GT(error(with(few)), tolerance) << few << " modes do where " << m << " are taken";
  }
}

} // namespace
} // namespace gestell
