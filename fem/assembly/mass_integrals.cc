#include "fem/assembly/mass_integrals.h"

#include "fem/assembly/elasticity.h"

namespace gestell::fem
{

namespace
{

Eigen::Map<const Eigen::Vector3d> point(const QuadraticMesh &mesh, int node)
{
  return Eigen::Map<const Eigen::Vector3d>(mesh.points[node].data());
}

} // namespace

NodalMasses nodal_masses(const QuadraticMesh &mesh, const CellMaterials &materials, const Eigen::Vector3d &origin)
{
  NodalMasses masses{Eigen::VectorXd::Zero(mesh.n_nodes()), Eigen::Matrix3Xd::Zero(3, mesh.n_nodes())};
  CellValues  values(mesh, CellPoints::rule);
  for (int cell = 0; cell < mesh.n_cells(); ++cell)
  {
    const Eigen::MatrixXd M      = mass_matrix(values.of(cell), materials[cell].rho);
    const Eigen::MatrixXd moment = (positions(mesh, cell).colwise() - origin) * M;
    for (Eigen::Index a = 0; a < M.cols(); ++a)
    {
      masses.mass[mesh.nodes(cell)[a]] += M.col(a).sum();
      masses.moment.col(mesh.nodes(cell)[a]) += moment.col(a);
    }
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
  CellValues values(quadratic, CellPoints::rule);
  for (int cell = 0; cell < mesh.n_cells(); ++cell)
    parts[materials.of_cell[cell]].mass += materials[cell].rho * values.of(cell).weight.sum();
  return parts;
}

Eigen::Vector3d middle_of_nodes(const QuadraticMesh &mesh)
{
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (int i = 0; i < mesh.n_nodes(); ++i)
    middle += point(mesh, i) / mesh.n_nodes();
  return middle;
}

} // namespace gestell::fem
