// A frame in elements of degree three as a frame of its own: what it must share with that of degree two, and what not.

#include "fem/recovery/raised_matrices.h"
#include "tests/support/box_mesh.h"
#include "tests/support/test.h"

#include <Eigen/SparseCholesky>

namespace gestell::test
{
namespace
{

/// A cantilever of 1 m x 0.1 m x 0.1 m, its end a rigid interface.
fem::FrameSpecification cantilever_specification()
{
  fem::FrameSpecification specification = free_steel();
  specification.supports                = {clamped("foot", {"x0"})};
  specification.interfaces              = {interface("tip", {"x1"}, fem::InterfaceCoupling::rigid)};
  return specification;
}

fem::Mesh beam(int cells)
{
  return box_mesh({5 * cells, cells, cells}, {1., 0.1, 0.1}, 0.2);
}

/// [m/N] down, at the tip.
double compliance(const fem::FrameMatrices &frame)
{
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(frame.C);
  const int                                                z = frame.interfaces.at(0).coordinate[fem::uz];
  return factor.solve(Eigen::VectorXd::Unit(frame.C.rows(), z))[z];
}

} // namespace

/// Degree three bends more than degree two, and less than the truth; at most (2/3)^2 of the error is left to it, as at
/// the edge of a clamp (docs/theory/mesh_error.md).
TEST(RaisedMatrices, BendMoreThanTheQuadraticOnesByAboutTheirError)
{
  const auto   specification = cantilever_specification();
  const auto   coarse        = fem::discretise_with_mesh_error(beam(1), specification);
  const auto   fine          = fem::discretise_with_mesh_error(beam(3), specification);
  const double quadratic = compliance(coarse.matrices), cubic = compliance(fem::raised_matrices(coarse, specification)),
               truth = compliance(fem::raised_matrices(fine, specification));
  EXPECT_GT(cubic, quadratic);
  EXPECT_LT(cubic, truth);
  EXPECT_GT(cubic - quadratic, 5. / 9. * (truth - quadratic));
}

/// Rigid motions are linear fields: no energy, the same mass, whatever the degree; Rayleigh's damping follows M and C.
TEST(RaisedMatrices, KeepRigidMotionsMassAndDamping)
{
  fem::FrameSpecification specification = free_steel();
  specification.interfaces              = {interface("tip", {"x1"}, fem::InterfaceCoupling::rigid)};
  specification.rayleigh_mass           = 3.;
  specification.rayleigh_stiffness      = 2e-5;
  const auto               coarse       = fem::discretise_with_mesh_error(beam(1), specification);
  const fem::FrameMatrices raised       = fem::raised_matrices(coarse, specification);
  ASSERT_GT(raised.M.rows(), 2 * coarse.matrices.M.rows());
  const Eigen::MatrixXd R = raised.rigid_motions;
  EXPECT_LT((raised.C * R).norm(), 1e-12 * raised.C.norm() * R.norm());
  const double mass = raised.translations.col(2).dot(raised.M * raised.translations.col(2));
  EXPECT_NEAR(mass, coarse.matrices.mass, 1e-9 * mass);
  // The quadratics take their weight, the cubics what is theirs.
  const Eigen::VectorXd weight = raised.M * raised.translations.col(2);
  EXPECT_LT((raised.acceleration_load.col(2) - weight).norm(), 1e-9 * weight.norm());
  const Eigen::SparseMatrix<double> B = 3. * raised.M + 2e-5 * raised.C;
  EXPECT_LT((B - raised.B).norm(), 1e-12 * B.norm());
}

/// A foundation acts on the quadratics alone, so its force is told; that of a clamp is not.
TEST(RaisedMatrices, TellForcesOfFoundationsAlone)
{
  fem::FrameSpecification specification = cantilever_specification();
  specification.supports.push_back(foundation("pad", {"z0"}, {1e6, 1e6, 1e7}));
  const auto               coarse = fem::discretise_with_mesh_error(beam(1), specification);
  const fem::FrameMatrices raised = fem::raised_matrices(coarse, specification);
  ASSERT_EQ(coarse.matrices.outputs.size(), 6u);
  ASSERT_EQ(raised.outputs.size(), 3u);
  EXPECT_NEAR(output(raised, "support.pad.z").on_q.dot(raised.translations.col(2)),
              output(coarse.matrices, "support.pad.z").on_q.dot(coarse.matrices.translations.col(2)), 1e-3);
}

} // namespace gestell::test
