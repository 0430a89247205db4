// A frame summed up part by part, as several ranks do, is the frame to the last bit.

#include "fem/cell_parts.h"
#include "fem/discretisation.h"
#include "fem/part_sums.h"
#include "tests/fem/box_mesh.h"
#include "tests/fem/brick_mesh.h"

#include <gtest/gtest.h>

#include <utility>

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
                    const fem::Kinematics &kinematics, const SparseMatrix &, const SparseMatrix &) const override
  {
    const fem::FrameDivision            division = fem::divide(mesh, kinematics, n_parts_);
    const Eigen::Vector3d               middle   = fem::middle_of_nodes(mesh);
    std::vector<Eigen::Triplet<double>> C, M;
    fem::RigidEnergies                  energies;
    fem::NodalMasses                    masses{Eigen::VectorXd(mesh.n_nodes()), Eigen::Matrix3Xd(3, mesh.n_nodes())};
    for (int part = 0; part < n_parts_; ++part)
    {
      std::vector<int>        nodes, own;
      const auto              of_part = fem::frame_part(mesh, materials, kinematics, division, part, nodes);
      const fem::PartSums     sums    = fem::sum_part(of_part, middle);
      const std::vector<int> &q       = of_part.kinematics.coordinates;
      add(sums.C, of_part.own_coordinates, q, C);
      add(sums.M, of_part.own_coordinates, q, M);
      for (const int node : of_part.own_nodes)
        own.push_back(nodes[node]);
      masses.mass(own)               = sums.masses.mass;
      masses.moment(Eigen::all, own) = sums.masses.moment;
      energies.energy += sums.energies.energy;
      energies.cancelling += sums.energies.cancelling;

      EXPECT_GT(own.size(), std::size_t(mesh.n_nodes() / n_parts_ / 2)) << "parts are alike in size";
      EXPECT_LT(of_part.mesh.n_cells(), mesh.n_cells()) << "a part has the cells it needs only";
    }
    fem::CellSums sums;
    for (auto [entries, A] : {std::pair(&C, &sums.C), std::pair(&M, &sums.M)})
    {
      A->resize(kinematics.n_coordinates(), kinematics.n_coordinates());
      A->setFromTriplets(entries->begin(), entries->end());
    }
    sums.nodal_mass   = masses.mass;
    sums.whole        = fem::weigh(mesh, masses, middle);
    sums.rigid_energy = energies.share();
    return sums;
  }

private:
  static void add(const fem::CompressedRows &rows, const std::vector<int> &row, const std::vector<int> &column,
                  std::vector<Eigen::Triplet<double>> &entries)
  {
    ASSERT_EQ(rows.n_rows(), int(row.size()));
    for (int i = 0; i < rows.n_rows(); ++i)
      for (int k = rows.begin[i]; k < rows.begin[i + 1]; ++k)
        entries.emplace_back(column[row[i]], column[rows.column[k]], rows.value[k]);
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

/// The same entries, and the same numbers in them.
void expect_equal(const SparseMatrix &A, const SparseMatrix &B)
{
  ASSERT_EQ(A.nonZeros(), B.nonZeros());
  for (int j = 0; j < B.outerSize(); ++j)
    for (SparseMatrix::InnerIterator a(A, j), b(B, j); a && b; ++a, ++b)
    {
      ASSERT_EQ(a.row(), b.row());
      ASSERT_EQ(a.value(), b.value()) << b.row() << " " << j;
    }
}

void expect_same(const fem::Mesh &mesh, fem::InterfaceCoupling coupling)
{
  const auto               specification = every_kind(coupling);
  const fem::FrameMatrices whole         = discretise(mesh, specification);
  for (const int n_parts : {2, 3, 4})
  {
    const PartByPart         by_parts(n_parts);
    const fem::FrameMatrices parts = discretise(mesh, specification, &by_parts);
    expect_equal(parts.C, whole.C);
    expect_equal(parts.M, whole.M);
    expect_equal(parts.B, whole.B);
    EXPECT_EQ(parts.acceleration_load, whole.acceleration_load);
    EXPECT_EQ(parts.mass, whole.mass);
    EXPECT_EQ(parts.facts.whole.centre, whole.facts.whole.centre);
    EXPECT_EQ(parts.facts.whole.inertia, whole.facts.whole.inertia);
    EXPECT_LT(parts.facts.rigid_energy, 1e-15);
    ASSERT_EQ(parts.outputs.size(), whole.outputs.size());
    for (std::size_t i = 0; i < whole.outputs.size(); ++i)
    {
      EXPECT_EQ(parts.outputs[i].name, whole.outputs[i].name);
      EXPECT_EQ(parts.outputs[i].on_q, whole.outputs[i].on_q);
    }
  }
}

TEST(CellParts, OfTetrahedraHaveTheRowsOfTheFrame)
{
  for (const auto coupling : {fem::InterfaceCoupling::rigid, fem::InterfaceCoupling::average})
    expect_same(box_mesh({5, 3, 3}, {1., 0.5, 0.6}, 0.2), coupling);
}

TEST(CellParts, OfHexahedraHaveTheRowsOfTheFrame)
{
  for (const auto coupling : {fem::InterfaceCoupling::rigid, fem::InterfaceCoupling::average})
    expect_same(brick_mesh({5, 3, 3}, {1., 0.5, 0.6}, 0.2), coupling);
}

// Its 121 nodes fall into two groups, which have inner coordinates.
TEST(CellParts, HaveTheRowsOfALargeAveragedSurface)
{
  expect_same(box_mesh({3, 5, 5}, {1., 0.5, 0.6}, 0.2), fem::InterfaceCoupling::average);
}

} // namespace
} // namespace gestell::test
