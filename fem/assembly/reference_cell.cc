#include "fem/assembly/reference_cell.h"

#include "fem/mesh/hexahedron.h"

namespace gestell::fem
{

namespace
{

constexpr double gauss_near = 0.58541019662496845, gauss_far = 0.1381966011250105; // barycentric, rule of degree 2

// Between which corners a node stands; the order of FE_SimplexP<3>(2).
constexpr std::array<std::array<int, 2>, 6> edges = {{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};

void add_of_tetrahedron(const Eigen::Vector4d &L, ReferenceCell::Points &points)
{
  Eigen::Matrix<double, 4, 3> slope; // of the barycentric coordinates
  slope << -1., -1., -1., Eigen::Matrix3d::Identity();
  Eigen::VectorXd              N(10);
  Eigen::Matrix<double, -1, 3> dN(10, 3);
  for (int i = 0; i < 4; ++i)
  {
    N[i]      = L[i] * (2. * L[i] - 1.);
    dN.row(i) = (4. * L[i] - 1.) * slope.row(i);
  }
  for (int e = 0; e < 6; ++e)
  {
    const auto [a, b] = edges[e];
    N[4 + e]          = 4. * L[a] * L[b];
    dN.row(4 + e)     = 4. * (L[a] * slope.row(b) + L[b] * slope.row(a));
  }
  points.add(N, dN);
}

ReferenceCell tetrahedron()
{
  ReferenceCell cell;
  cell.n_nodes = 10;
  cell.corners = {0, 1, 2, 3};
  for (int i = 0; i < 4; ++i)
  {
    cell.between.push_back({i});
    Eigen::Vector4d L = Eigen::Vector4d::Constant(gauss_far);
    L[i]              = gauss_near;
    add_of_tetrahedron(L, cell.samples);
    add_of_tetrahedron(Eigen::Vector4d::Unit(i), cell.nodes);
  }
  for (const auto &[a, b] : edges)
  {
    cell.between.push_back({a, b});
    add_of_tetrahedron(0.5 * (Eigen::Vector4d::Unit(a) + Eigen::Vector4d::Unit(b)), cell.nodes);
  }
  return cell;
}

ReferenceCell hexahedron_cell()
{
  ReferenceCell cell;
  cell.n_nodes = hexahedron::n_nodes;
  cell.corners.assign(hexahedron::corners.begin(), hexahedron::corners.end());
  for (int node = 0; node < cell.n_nodes; ++node)
  {
    const Eigen::Vector3d xi = hexahedron::node_position(node);
    cell.nodes.add(hexahedron::values(xi), hexahedron::gradients(xi));
    std::vector<int> amid;
    for (int c = 0; c < 8; ++c)
      if (((hexahedron::node_position(hexahedron::corners[c]) - xi).array().abs() < 1.5).all())
        amid.push_back(c);
    cell.between.push_back(amid);
  }
  for (const auto &point : hexahedron::quadrature(2))
    cell.samples.add(point.N, point.dN);
  return cell;
}

} // namespace

void ReferenceCell::Points::add(const Eigen::VectorXd &values, const Eigen::Matrix<double, -1, 3> &slopes)
{
  N.conservativeResize(values.size(), N.cols() + 1);
  dN.conservativeResize(values.size(), dN.cols() + 3);
  N.rightCols(1)  = values;
  dN.rightCols(3) = slopes;
}

const ReferenceCell &reference_cell(const QuadraticMesh &mesh)
{
  static const ReferenceCell four = tetrahedron(), eight = hexahedron_cell();
  return mesh.hexahedra.empty() ? four : eight;
}

Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 27> positions(const QuadraticMesh &mesh, int cell)
{
  const int                                          n     = mesh.nodes_per_cell();
  const int                                         *nodes = mesh.nodes(cell);
  Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 27> X(3, n);
  for (int a = 0; a < n; ++a)
    X.col(a) = Eigen::Map<const Eigen::Vector3d>(mesh.points[nodes[a]].data());
  return X;
}

} // namespace gestell::fem
