#include "fem/assembly/mass_integrals.h"

#include "fem/assembly/elasticity.h"
#include "fem/assembly/rigid_motions.h"

namespace gestell::fem
{

namespace
{

Eigen::Map<const Eigen::Vector3d> point(const QuadraticMesh &mesh, int node)
{
  return Eigen::Map<const Eigen::Vector3d>(mesh.points[node].data());
}

} // namespace

NodalMasses nodal_masses(const QuadraticMesh &mesh, const BlockMatrix &M, const Eigen::Vector3d &origin)
{
  const BlockMatrix::Rows rows = M.rows();
  NodalMasses             masses{Eigen::VectorXd::Zero(M.n_nodes()), Eigen::Matrix3Xd::Zero(3, M.n_nodes())};
  for (int i = 0; i < M.n_nodes(); ++i)
    for (int k = rows.begin[i]; k < rows.begin[i + 1]; ++k)
    {
      masses.mass[i] += rows.values[k];
      masses.moment.col(i) += rows.values[k] * (point(mesh, rows.columns[k]) - origin);
    }
  return masses;
}

MassProperties mass_integrals(const QuadraticMesh &mesh, const NodalMasses &masses, const Eigen::Vector3d &origin)
{
  MassProperties whole;
  whole.mass                = masses.mass.sum();
  const Eigen::Vector3d arm = masses.moment.rowwise().sum() / whole.mass;
  whole.centre              = origin + arm;

  Eigen::Matrix3d S = Eigen::Matrix3d::Zero();
  for (int i = 0; i < mesh.n_nodes(); ++i)
    S += (point(mesh, i) - origin) * masses.moment.col(i).transpose();
  S -= whole.mass * arm * arm.transpose();
  S             = 0.5 * (S + S.transpose()).eval();
  whole.inertia = S.trace() * Eigen::Matrix3d::Identity() - S;
  return whole;
}

Eigen::MatrixXd acceleration_load(const Eigen::VectorXd &nodal_mass, const AffineConstraints &affine)
{
  Eigen::MatrixXd result(affine.n_coordinates(), 3);
  for (int d = 0; d < 3; ++d)
  {
    Eigen::VectorXd load                       = Eigen::VectorXd::Zero(3 * nodal_mass.size());
    load(Eigen::seqN(d, nodal_mass.size(), 3)) = nodal_mass;
    result.col(d)                              = affine.gather(load);
  }
  return result;
}

std::vector<FrameFacts::SolidMass> solid_masses(const Mesh &mesh, const QuadraticMesh &quadratic,
                                                const CellMaterials &materials)
{
  std::vector<FrameFacts::SolidMass> parts;
  for (std::size_t solid = 0; solid < mesh.solids.size(); ++solid)
    parts.push_back({mesh.solids[solid], materials.materials[solid].name});
  for (int cell = 0; cell < mesh.n_cells(); ++cell)
    parts[materials.of_cell[cell]].mass += cell_mass(quadratic, cell, materials[cell]).sum();
  return parts;
}

Eigen::Vector3d middle_of_nodes(const QuadraticMesh &mesh)
{
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (int i = 0; i < mesh.n_nodes(); ++i)
    middle += point(mesh, i) / mesh.n_nodes();
  return middle;
}

RigidEnergies rigid_energies(const QuadraticMesh &mesh, const BlockMatrix &C, const Eigen::Vector3d &middle,
                             const std::vector<int> &nodes)
{
  using Motions                = Eigen::Matrix<double, 3, 6>;
  const BlockMatrix::Rows rows = C.rows();
  RigidEnergies           result;
  for (const int i : nodes)
  {
    Motions force = Motions::Zero(), terms = Motions::Zero();
    for (int k = rows.begin[i]; k < rows.begin[i + 1]; ++k)
    {
      const Eigen::Map<const Eigen::Matrix3d> block(rows.values + 9 * k);
      const Motions                           u = rigid_motions_of_point(mesh.points[rows.columns[k]], middle);
      force += block * u;
      terms += block.cwiseAbs() * u.cwiseAbs();
    }
    const Motions u = rigid_motions_of_point(mesh.points[i], middle);
    result.energy += u.cwiseProduct(force).colwise().sum();
    result.cancelling += u.cwiseAbs().cwiseProduct(terms).colwise().sum();
  }
  return result;
}

} // namespace gestell::fem
