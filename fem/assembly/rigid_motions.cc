#include "fem/assembly/rigid_motions.h"

namespace gestell::fem
{

Eigen::MatrixXd rigid_displacements(const QuadraticMesh &mesh, const Eigen::Vector3d &x0)
{
  Eigen::MatrixXd u(3 * mesh.n_nodes(), 6);
  for (int i = 0; i < mesh.n_nodes(); ++i)
    u.middleRows<3>(3 * i) = rigid_motions_of_point(mesh.points[i], x0);
  return u;
}

Eigen::MatrixXd rigid_coordinates(const QuadraticMesh &mesh, const Eigen::Vector3d &x0,
                                  const MultipointConstraints &constraints, const AffineConstraints &affine,
                                  const std::vector<Interface> &interfaces)
{
  const Eigen::MatrixXd u = rigid_displacements(mesh, x0);
  Eigen::MatrixXd       q = Eigen::MatrixXd::Zero(affine.n_coordinates(), 6);
  for (int i = 0; i < u.rows(); ++i)
    if (const int coordinate = affine.coordinate(i); coordinate >= 0)
      q.row(coordinate) = u.row(i);

  for (std::size_t k = 0; k < constraints.measures.size(); ++k)
    for (const auto &[displacement, weight] : constraints.measures[k])
      q.row(affine.coordinate(constraints.first_new() + static_cast<int>(k))) += weight * u.row(displacement);

  for (const Interface &interface : interfaces)
  {
    const auto R = rigid_motions_of_point(interface.position, x0);
    for (int d = 0; d < 3; ++d)
    {
      q.row(interface.coordinate[d]) = R.row(d);
      if (const int rotation = interface.coordinate[3 + d]; rotation >= 0)
        q.row(rotation) = Eigen::RowVectorXd::Unit(6, 3 + d);
    }
  }
  return q;
}

} // namespace gestell::fem
