#include "fem/assembly/rigid_motions.h"

#include <algorithm>

namespace gestell::fem
{

Eigen::MatrixXd rigid_displacements(const QuadraticMesh &mesh, const Eigen::Vector3d &x0)
{
  Eigen::MatrixXd u(3 * mesh.n_nodes(), 6);
  for (int i = 0; i < mesh.n_nodes(); ++i)
    u.middleRows<3>(3 * i) = rigid_motions_of_point(mesh.points[i], x0);
  return u;
}

Eigen::MatrixXd rigid_coordinates(const QuadraticMesh &mesh, const Eigen::Vector3d &x0, const AffineConstraints &affine,
                                  const std::vector<Interface> &interfaces)
{
  const Eigen::MatrixXd u = rigid_displacements(mesh, x0);
  Eigen::MatrixXd       q = Eigen::MatrixXd::Zero(affine.n_coordinates(), 6);
  for (int i = 0; i < u.rows(); ++i)
    if (const int coordinate = affine.coordinate(i); coordinate >= 0)
      q.row(coordinate) = u.row(i);

  const MultipointConstraints &constraints = affine.constraints();
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

double rigid_energy_share(const SparseMatrix &C, const Eigen::MatrixXd &motions, const QuadraticMesh &mesh,
                          const AffineConstraints &affine)
{
  const auto       &holder = affine.constraints().holder;
  std::vector<char> counts(C.cols(), 1);
  for (int cell = 0; cell < mesh.n_cells(); ++cell)
  {
    const int *const nodes = mesh.nodes(cell), *const end = nodes + mesh.n_nodes_of(cell);
    if (std::any_of(nodes, end, [&](int node) { return holder.count(node) > 0; }))
      std::for_each(nodes, end,
                    [&](int node)
                    {
                      for (int i = 3 * node; i < 3 * node + 3; ++i)
                        for (const auto &[coordinate, weight] : affine.row(i))
                          counts[coordinate] = 0;
                    });
  }
  using Row6 = Eigen::Array<double, 1, 6>; // all six at once: C is read once
  const Eigen::Array<double, Eigen::Dynamic, 6, Eigen::RowMajor> q      = motions;
  Row6                                                           energy = Row6::Zero(), cancelling = Row6::Zero();
  for (Eigen::Index j = 0; j < C.cols(); ++j)
    if (counts[j])
    {
      Row6 force = Row6::Zero(), terms = Row6::Zero();
      for (SparseMatrix::InnerIterator entry(C, j); entry; ++entry) // column j is row j
      {
        const Row6 term = entry.value() * q.row(entry.row());
        force += term;
        terms += term.abs();
      }
      energy += (q.row(j) * force).abs();
      cancelling += q.row(j).abs() * terms;
    }
  return (energy / cancelling).maxCoeff<Eigen::PropagateNaN>();
}

} // namespace gestell::fem
