// A frame summed up part by part, as several ranks do, is the frame.

#include "fem/cell_parts.h"
#include "fem/discretisation.h"
#include "fem/elasticity.h"
#include "fem/weighing.h"
#include "tests/fem/box_mesh.h"
#include "tests/fem/brick_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace gestell::test
{
namespace
{

using SparseMatrix = Eigen::SparseMatrix<double>;

/// Several parts, each knowing its own cells alone, one after the other.
class PartByPart final : public fem::CellAssembly
{
public:
  explicit PartByPart(int n_parts) : n_parts_(n_parts) {}

  fem::CellSums sum(const fem::QuadraticMesh &mesh, const fem::CellMaterials &materials,
                    const fem::Kinematics &kinematics, const SparseMatrix &C_beside,
                    const SparseMatrix &M_beside) const override
  {
    const std::vector<int> part_of_cell = fem::part_cells(mesh, n_parts_);
    const std::vector<int> part_of_node = fem::part_nodes(mesh, part_of_cell, n_parts_);
    fem::CellSums          sums;
    fem::RigidEnergies     energies;
    sums.C          = C_beside;
    sums.M          = M_beside;
    sums.nodal_mass = Eigen::VectorXd::Zero(mesh.n_nodes());
    for (int part = 0; part < n_parts_; ++part)
    {
      std::vector<int>        nodes;
      const auto              own = fem::frame_part(mesh, materials, kinematics, part_of_cell, part, nodes);
      const fem::Kinematics   of_part(own.kinematics);
      const fem::BlockMatrix  C = fem::assemble_stiffness(own.mesh, own.materials);
      const fem::BlockMatrix  M = fem::assemble_mass(own.mesh, own.materials);
      const std::vector<int> &q = own.kinematics.coordinates;
      sums.C += spread(of_part.project(C), q, kinematics.n_coordinates());
      sums.M += spread(of_part.project(M), q, kinematics.n_coordinates());
      sums.nodal_mass(nodes) += fem::nodal_mass(M);
      sums.whole.add(fem::weigh(own.mesh, M));
      const auto more = fem::rigid_energies(own.mesh, C, fem::middle_of_nodes(mesh));
      energies.energy += more.energy;
      energies.cancelling += more.cancelling;

      EXPECT_GT(own.mesh.n_cells(), mesh.n_cells() / n_parts_ / 2) << "parts are alike in size";
      EXPECT_LT(own.mesh.n_nodes(), mesh.n_nodes()) << "a part has its own nodes only";
      for (int node = 0; node < mesh.n_nodes(); ++node)
        if (part_of_node[node] == part)
          EXPECT_TRUE(std::binary_search(nodes.begin(), nodes.end(), node)) << "a node belongs to a part that has it";
    }
    sums.rigid_energy = energies.share();
    return sums;
  }

private:
  static SparseMatrix spread(const SparseMatrix &A, const std::vector<int> &to, int n)
  {
    std::vector<Eigen::Triplet<double>> entries;
    for (int j = 0; j < A.outerSize(); ++j)
      for (SparseMatrix::InnerIterator a(A, j); a; ++a)
        entries.emplace_back(to[a.row()], to[j], a.value());
    SparseMatrix whole(n, n);
    whole.setFromTriplets(entries.begin(), entries.end());
    return whole;
  }

  int n_parts_;
};

/// A foundation, a side clamped in two directions, an interface with a mass, damping.
fem::FrameSpecification every_kind(fem::InterfaceCoupling coupling)
{
  fem::AttachedMass motor;
  motor.name      = "motor";
  motor.interface = "end";
  motor.mass      = 20.;
  motor.inertia   = Eigen::Matrix3d::Identity();

  fem::FrameSpecification frame = free_steel();
  frame.supports                = {foundation("feet", {"z0"}, {{1e7, 2e7, 3e7}}, {{1e3, 2e3, 3e3}}),
                                   clamped("wall", {"x0"}, {{true, true, false}})};
  frame.interfaces              = {interface("end", {"x1"}, coupling)};
  frame.masses                  = {motor};
  frame.rayleigh_mass           = 2.;
  frame.rayleigh_stiffness      = 1e-5;
  return frame;
}

void expect_same(const fem::Mesh &mesh, fem::InterfaceCoupling coupling)
{
  const auto               specification = every_kind(coupling);
  const fem::FrameMatrices whole         = discretise(mesh, specification);
  for (const int n_parts : {2, 3})
  {
    const PartByPart         by_parts(n_parts);
    const fem::FrameMatrices parts = discretise(mesh, specification, &by_parts);
    // Sums in another order: some ten roundings of the largest entry.
    const auto expect_near = [](const SparseMatrix &A, const SparseMatrix &B)
    { EXPECT_LT(SparseMatrix(A - B).coeffs().abs().maxCoeff(), 3e-15 * B.coeffs().abs().maxCoeff()); };
    expect_near(parts.C, whole.C);
    expect_near(parts.M, whole.M);
    expect_near(parts.B, whole.B);
    EXPECT_LT((parts.acceleration_load - whole.acceleration_load).norm(), 1e-13 * whole.acceleration_load.norm());
    EXPECT_NEAR(parts.mass, whole.mass, 1e-12 * whole.mass);
    EXPECT_LT((parts.facts.whole.centre - whole.facts.whole.centre).norm(), 1e-13);
    EXPECT_LT((parts.facts.whole.inertia - whole.facts.whole.inertia).norm(), 1e-12 * whole.facts.whole.inertia.norm());
    EXPECT_LT(parts.facts.rigid_energy, 1e-15);
    ASSERT_EQ(parts.outputs.size(), whole.outputs.size());
    for (std::size_t i = 0; i < whole.outputs.size(); ++i)
    {
      EXPECT_EQ(parts.outputs[i].name, whole.outputs[i].name);
      EXPECT_LE((parts.outputs[i].on_q - whole.outputs[i].on_q).norm(), 1e-13 * whole.outputs[i].on_q.norm());
    }
  }
}

TEST(CellParts, OfTetrahedraAddUpToTheFrame)
{
  for (const auto coupling : {fem::InterfaceCoupling::rigid, fem::InterfaceCoupling::average})
    expect_same(box_mesh({5, 3, 3}, {1., 0.5, 0.6}, 0.2), coupling);
}

TEST(CellParts, OfHexahedraAddUpToTheFrame)
{
  for (const auto coupling : {fem::InterfaceCoupling::rigid, fem::InterfaceCoupling::average})
    expect_same(brick_mesh({5, 3, 3}, {1., 0.5, 0.6}, 0.2), coupling);
}

} // namespace
} // namespace gestell::test
