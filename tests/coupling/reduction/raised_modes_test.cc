// The error of a mesh, told by elements of degree three, on frames whose frequencies are known.

#include "coupling/reduction/estimates/raised_modes.h"

#include "coupling/algebra/sparse_cholesky.h"
#include "coupling/modes/modes.h"
#include "coupling/plugin/frame/mesh_statement.h"
#include "fem/recovery/discretisation.h"
#include "tests/support/box_mesh.h"
#include "tests/support/brick_mesh.h"
#include "tests/support/test.h"

#include <Eigen/Eigenvalues>

namespace gestell::test
{
namespace
{

constexpr double two_pi = 6.283185307179586;

struct Modes
{
  Eigen::VectorXd frequency_hz;
  Eigen::MatrixXd shape;
};

/// Twelve rounds of subspace iteration leave (omega_n / omega_(n + 8))^24 of the error: less than is asked for.
Modes lowest_modes(const fem::FrameMatrices &frame, int n)
{
  const coupling::SparseCholesky factor(frame.C, {});
  Eigen::MatrixXd                X = Eigen::MatrixXd::Random(frame.C.rows(), n + 8);
  Eigen::VectorXd                squares;
  for (int round = 0; round < 12; ++round)
  {
    X = frame.M * X;
    factor.solve_in_place(X);
    const Eigen::MatrixXd C = X.transpose() * (frame.C * X), M = X.transpose() * (frame.M * X);
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> ritz(C, M);
    X       = (X * ritz.eigenvectors()).eval();
    squares = ritz.eigenvalues();
  }
  return {squares.head(n).cwiseSqrt() / two_pi, X.leftCols(n)};
}

/// Told and true errors of the first frequencies of a frame clamped at x0.
struct Told
{
  Eigen::VectorXd frequency_hz, raised_hz, by_degree;
};

Told reported(const fem::Mesh &mesh, int n_modes)
{
  fem::FrameSpecification specification = free_steel();
  specification.supports                = {clamped("foot", {"x0"})};
  const auto            frame           = fem::discretise_with_mesh_error(mesh, specification);
  const Modes           modes           = lowest_modes(frame.matrices, n_modes + 4);
  const Eigen::VectorXd omega           = two_pi * modes.frequency_hz;
  const Eigen::VectorXd raised =
      coupling::raised_frequencies(frame.mesh_error->raised(frame.matrices), modes.shape, omega, false, INFINITY);
  Told result{modes.frequency_hz.head(n_modes), raised.head(n_modes) / two_pi, Eigen::VectorXd(n_modes)};
  for (int j = 0; j < n_modes; ++j)
    result.by_degree[j] = coupling::error_by_raising(omega[j], raised[j]);
  return result;
}

/// A plate folded along y at x = a into an angle, the corner mitred.
fem::Mesh folded(fem::Mesh mesh, double a)
{
  for (auto &[x, y, z] : mesh.points)
  {
    const double s = x, depth = z;
    x = s <= a ? s / a * (a - depth) : a - depth;
    z = s <= a ? depth : depth + (s - a) * (a - depth) / a;
  }
  return mesh;
}

struct Frame
{
  std::string         name;
  fem::Mesh           mesh;
  std::vector<double> truth; ///< lowest frequencies [Hz]
};

/// A square plate of 1 m clamped along one side: Leissa's frequency parameters for nu = 0.3.
std::vector<double> plate(double thickness)
{
  const double unit = thickness * std::sqrt(210e9 / 12. / (1. - 0.09) / 7850.) / two_pi;
  return {3.471 * unit, 8.507 * unit};
}

/// A cantilever beam of Euler and Bernoulli of 1 m with a square section, in both directions.
std::vector<double> beam(double thickness)
{
  const double first = 3.516 * thickness * std::sqrt(210e9 / 7850. / 12.) / two_pi;
  return {first, first};
}

/// By the same frame in many hexahedra of degree three.
std::vector<double> truth_of(const fem::Mesh &fine)
{
  const Told own = reported(fine, 2);
  return {own.raised_hz[0], own.raised_hz[1]};
}

std::vector<Frame> frames()
{
  std::vector<Frame> result;
  for (const double t : {0.05, 0.01, 0.001})
    for (const int n : {2, 4})
    {
      result.push_back({"plate, tetrahedra", box_mesh({n, n, 1}, {1., 1., t}, 0.2), plate(t)});
      result.push_back({"plate, hexahedra", brick_mesh({n, n, 1}, {1., 1., t}), plate(t)});
    }
  for (const int n : {2, 4})
  {
    result.push_back({"beam, tetrahedra", box_mesh({n, 1, 1}, {1., 0.05, 0.05}), beam(0.05)});
    result.push_back({"beam, hexahedra", brick_mesh({n, 1, 1}, {1., 0.05, 0.05}), beam(0.05)});
  }
  const auto block = truth_of(brick_mesh({4, 4, 4}, {1., 1., 1.}));
  for (const int n : {1, 2})
    result.push_back({"block, tetrahedra", box_mesh({n, n, n}, {1., 1., 1.}), block});
  const auto angle = truth_of(folded(brick_mesh({12, 8, 1}, {1., 1., 0.01}), 0.5));
  for (const int n : {2, 4})
  {
    result.push_back({"angle, tetrahedra", folded(box_mesh({n, n, 1}, {1., 1., 0.01}), 0.5), angle});
    result.push_back({"angle, hexahedra", folded(brick_mesh({n, n, 1}, {1., 1., 0.01}), 0.5), angle});
  }
  return result;
}

TEST(RaisedDegree, TellsNoLessThanHalfOfTheErrorOfAFrequencyAndNoMoreThanTwoAndAHalfTimes)
{
  // The theories of thin plates and beams, and the finest meshes, are themselves some 0.3 % off.
  constexpr double known = 0.003;
  for (const auto &[name, mesh, truth] : frames())
  {
    const Told own = reported(mesh, int(truth.size()));
    for (std::size_t j = 0; j < truth.size(); ++j)
    {
      const double error = own.frequency_hz[j] / truth[j] - 1.;
      EXPECT_GT(own.by_degree[j], 0.5 * (error - known)) << name << ", " << mesh.n_cells() << " cells, mode " << j;
      EXPECT_LT(own.by_degree[j], 2.5 * (error + known)) << name << ", " << mesh.n_cells() << " cells, mode " << j;
    }
  }
}

TEST(RaisedDegree, LowersFrequenciesAndKeepsWhatIsExact)
{
  // Stretching a rod without lateral contraction is exact in neither; but no frequency rises, and the matrices stay
  // symmetric.
  fem::FrameSpecification specification = free_steel();
  specification.supports                = {clamped("foot", {"x0"})};
  for (const fem::Mesh &mesh : {box_mesh({3, 2, 2}, {1., 0.5, 0.4}, 0.2), brick_mesh({3, 2, 2}, {1., 0.5, 0.4}, 0.2)})
  {
    const auto   frame  = fem::discretise_with_mesh_error(mesh, specification);
    const Modes  modes  = lowest_modes(frame.matrices, 6);
    const auto   raised = frame.mesh_error->raised(frame.matrices);
    const double size   = raised.C.norm();
    EXPECT_LT(Eigen::SparseMatrix<double>(raised.C - Eigen::SparseMatrix<double>(raised.C.transpose())).norm(),
              1e-14 * size);
    const Eigen::VectorXd omega =
        coupling::raised_frequencies(raised, modes.shape, two_pi * modes.frequency_hz, false, INFINITY);
    for (int j = 0; j < 4; ++j)
      EXPECT_LT(omega[j], two_pi * modes.frequency_hz[j]);
  }
}

TEST(RaisedDegree, OfAFreeFrameCostsNoEnergyInRigidMotions)
{
  for (const fem::Mesh &mesh : {box_mesh({2, 2, 1}, {1., 0.5, 0.4}, 0.2), brick_mesh({2, 2, 1}, {1., 0.5, 0.4})})
  {
    const auto      frame  = fem::discretise_with_mesh_error(mesh, free_steel());
    const auto      raised = frame.mesh_error->raised(frame.matrices);
    Eigen::MatrixXd R      = Eigen::MatrixXd::Zero(raised.C.rows(), 6);
    for (std::size_t i = 0; i < raised.place.size(); ++i)
      R.row(raised.place[i]) = frame.matrices.rigid_motions.row(Eigen::Index(i));
    EXPECT_LT((raised.C * R).norm(), 1e-10 * raised.C.norm() * R.norm());
  }
}

TEST(MeshErrorEstimate, JudgesTheModeAtTheLimitThoughItsReducedFrequencyLiesAbove)
{
  fem::FrameSpecification specification = free_steel();
  specification.supports                = {clamped("foot", {"x0"})};
  specification.interfaces              = {interface("tip", {"x1"}, fem::InterfaceCoupling::rigid)};
  const auto frame = fem::discretise_with_mesh_error(brick_mesh({6, 1, 1}, {1., 0.1, 0.07}), specification);
  coupling::ReductionOptions options;
  options.n_modes                   = 3;
  coupling::ReducedModel reduced    = coupling::reduce_with_basis(frame.matrices, options);
  const double           refined_hz = coupling::refined_hz(reduced.frame, 2);
  ASSERT_GT(reduced.frame.frequency_error[2], 1e-5) << "the test needs a reduction with an error";
  reduced.frame.frequency_limit_hz = refined_hz;
  EXPECT_EQ(coupling::modal_mesh_error(reduced, frame.matrices, *frame.mesh_error, true).error.size(), 3);
}

} // namespace
} // namespace gestell::test
