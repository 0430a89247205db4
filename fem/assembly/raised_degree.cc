#include "fem/assembly/raised_degree.h"

#include "fem/assembly/elasticity.h"
#include "fem/assembly/reference_cell.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace gestell::fem
{

namespace
{

using Local = CubicFunctions::Local;

using Line = Eigen::Vector4d; // a + b . xi

/// L_k of the corners of a triangle or a tetrahedron.
Line barycentric(int corner, int dim)
{
  Line line = Line::Zero();
  if (corner == 0)
    line.head(dim + 1) << 1., Eigen::VectorXd::Constant(dim, -1.);
  else
    line[corner] = 1.;
  return line;
}

/// The functions of one kind of cell.
class Collector
{
public:
  explicit Collector(CellKind kind) : cell_(reference_cell(kind))
  {
    if (kind == CellKind::hexahedron)
      for (int d = 0; d < 3; ++d)
        add_along(d);
    else if (kind == CellKind::tetrahedron)
    {
      for (int a = 0; a < 4; ++a)
        for (int b = a + 1; b < 4; ++b)
          add_edge({a, b}, 3, 0.);
      for (int out = 0; out < 4; ++out)
        add_triangle({(out + 1) % 4, (out + 2) % 4, (out + 3) % 4}, 3, 0.);
    }
    else
    {
      for (const double level : {0., 0.5, 1.})
      {
        for (int a = 0; a < 3; ++a)
          add_edge({a, (a + 1) % 3}, 2, level);
        add_triangle({0, 1, 2}, 2, level);
      }
      add_along(2);
    }
  }
  std::vector<Local> functions;

private:
  int node_at(const Eigen::Vector3d &xi) const
  {
    Eigen::Index node = 0;
    (cell_.nodes.colwise() - xi).colwise().norm().minCoeff(&node);
    return static_cast<int>(node);
  }
  /// Corner of the simplex, at a height of the prism.
  static Eigen::Vector3d corner(int k, int dim, double level)
  {
    Eigen::Vector3d xi = Eigen::Vector3d::Zero();
    if (k > 0)
      xi[k - 1] = 1.;
    if (dim == 2)
      xi[2] = level;
    return xi;
  }
  int amid(int a, int b, int dim, double level) const
  {
    return node_at(0.5 * (corner(a, dim, level) + corner(b, dim, level)));
  }

  /// (L_a - L_b) N_ab
  void add_edge(const std::array<int, 2> &ends, int dim, double level)
  {
    const auto [a, b] = ends;
    const int middle  = amid(a, b, dim, level);
    functions.push_back({middle,
                         barycentric(a, dim) - barycentric(b, dim),
                         {node_at(corner(a, dim, level)), middle, node_at(corner(b, dim, level))},
                         true,
                         {middle}});
  }
  /// L_c N_ab
  void add_triangle(const std::array<int, 3> &corners, int dim, double level)
  {
    const auto [a, b, c] = corners;
    const int ab = amid(a, b, dim, level), bc = amid(b, c, dim, level), ca = amid(c, a, dim, level);
    functions.push_back({ab, barycentric(c, dim), {ab, bc, ca}, false, {ab, bc, ca}});
  }
  /// (2 xi_d - 1) N_m of nodes m half way along xi_d
  void add_along(int d)
  {
    Line line   = Line::Zero();
    line[0]     = -1.;
    line[d + 1] = 2.;
    for (int node = 0; node < cell_.n_nodes; ++node)
      if (const Eigen::Vector3d xi = cell_.nodes.col(node); std::abs(xi[d] - 0.5) < 0.1)
      {
        const Eigen::Vector3d half = 0.5 * Eigen::Vector3d::Unit(d);
        functions.push_back({node, line, {node_at(xi - half), node, node_at(xi + half)}, true, {node}});
      }
  }
  const ReferenceCell &cell_;
};

/// Quadratics and cubics of a cell.
class RaisedCells
{
public:
  RaisedCells(const QuadraticMesh &mesh, const CubicFunctions &cubics)
      : mesh_(mesh), cubics_(cubics), values_(mesh, CellPoints::finer)
  {
  }

  /// Functions follow the nodes of the mesh as further nodes.
  std::vector<int> nodes(int cell) const
  {
    std::vector<int> nodes(mesh_.nodes(cell), mesh_.nodes(cell) + mesh_.n_nodes_of(cell));
    for (const auto &[function, sign] : cubics_.numbers(cell))
      nodes.push_back(mesh_.n_nodes() + function);
    return nodes;
  }

  const PointValues &of(int cell)
  {
    const auto &[weight, N, dN]      = values_.of(cell);
    const Eigen::Matrix3Xd   &xi     = reference_cell(mesh_.kind(cell)).nodes;
    const std::vector<Local> &locals = CubicFunctions::of_cell(mesh_.kind(cell));
    const Eigen::Index        n = N.rows(), n_all = n + Eigen::Index(locals.size());
    all_.weight = weight;
    all_.N.resize(n_all, N.cols());
    all_.dN.resize(n_all, dN.cols());
    all_.N.topRows(n)  = N;
    all_.dN.topRows(n) = dN;
    for (std::size_t k = 0; k < locals.size(); ++k)
    {
      // The quadratics carry l, linear in xi, with its values at their nodes.
      const Local             &own = locals[k];
      const Eigen::RowVectorXd at_nodes =
          cubics_.numbers(cell)[k].second * ((own.line.tail<3>().transpose() * xi).array() + own.line[0]).matrix();
      const Eigen::RowVectorXd l = at_nodes * N, dl = at_nodes * dN;
      all_.N.row(n + Eigen::Index(k)) = l.cwiseProduct(N.row(own.amid));
      for (Eigen::Index p = 0; p < N.cols(); ++p)
        all_.dN.row(n + Eigen::Index(k)).segment<3>(3 * p) =
            l[p] * dN.row(own.amid).segment<3>(3 * p) + N(own.amid, p) * dl.segment<3>(3 * p);
    }
    return all_;
  }

private:
  const QuadraticMesh  &mesh_;
  const CubicFunctions &cubics_;
  CellValues            values_;
  PointValues           all_;
};

/// Values of the functions come after the displacements; those that vanish with fixed or tied nodes are held.
MultipointConstraints with_cubics(const AffineConstraints &affine, const CubicFunctions &cubics)
{
  MultipointConstraints result    = affine.constraints();
  const int             first_new = result.first_new();
  for (int k = 0; k < cubics.size(); ++k)
    for (int d = 0; d < 3; ++d)
    {
      const auto &with = cubics.vanish_with(k);
      result.held.push_back(
          std::all_of(with.begin(), with.end(), [&](int node) { return affine.coordinate(3 * node + d) < 0; }));
    }
  result.tie_of.resize(result.held.size(), -1);
  for (Combination &tie : result.ties)
    for (auto &[value, weight] : tie)
      if (value >= first_new)
        value += result.first_new() - first_new;
  return result;
}

/// The matrix A of the frame where the quadratics meet, foundations and masses included, and the cubics' own of
/// `cells`. Computed in place: a copy would be the largest object in memory.
SparseMatrix with_frame(SparseMatrix cells, const SparseMatrix &A, const std::vector<int> &place)
{
  std::vector<char> is_added(cells.cols(), 1);
  for (const int i : place)
    is_added[i] = 0;
  for (Eigen::Index j = 0; j < cells.cols(); ++j)
    for (SparseMatrix::InnerIterator entry(cells, j); entry; ++entry)
      if (!is_added[entry.row()] && !is_added[j])
        entry.valueRef() = 0.;
  SparseMatrix beyond(cells.rows(), cells.cols()); // masses and foundations that join what no cell does
  for (Eigen::Index j = 0; j < A.cols(); ++j)
  {
    const int *const begin = cells.innerIndexPtr() + cells.outerIndexPtr()[place[j]],
                     *end  = cells.innerIndexPtr() + cells.outerIndexPtr()[place[j] + 1];
    for (SparseMatrix::InnerIterator a(A, j); a; ++a)
    {
      const int *const at = std::lower_bound(begin, end, place[a.row()]);
      if (at != end && *at == place[a.row()])
        cells.valuePtr()[at - cells.innerIndexPtr()] = a.value();
      else
        beyond.coeffRef(place[a.row()], place[j]) = a.value();
    }
  }
  if (beyond.nonZeros() > 0)
    cells += beyond;
  return cells;
}

} // namespace

CubicFunctions::CubicFunctions(const QuadraticMesh &mesh) : numbers_(mesh.n_cells())
{
  std::map<std::array<int, 3>, int> known;
  for (int cell = 0; cell < mesh.n_cells(); ++cell)
    for (const Local &own : of_cell(mesh.kind(cell)))
    {
      const int         *nodes = mesh.nodes(cell);
      std::array<int, 3> key{nodes[own.nodes[0]], nodes[own.nodes[1]], nodes[own.nodes[2]]};
      const double       sign = own.odd && key[0] > key[2] ? -1. : 1.;
      std::sort(key.begin(), key.end());
      const auto [found, is_new] = known.emplace(key, size());
      if (is_new)
      {
        vanish_with_.emplace_back();
        for (const int node : own.vanish_with)
          vanish_with_.back().push_back(nodes[node]);
      }
      numbers_[cell].emplace_back(found->second, sign);
    }
}

const std::vector<Local> &CubicFunctions::of_cell(CellKind kind)
{
  static const std::vector<Local> four  = Collector(CellKind::tetrahedron).functions,
                                  eight = Collector(CellKind::hexahedron).functions,
                                  six   = Collector(CellKind::prism).functions;
  return kind == CellKind::tetrahedron ? four : kind == CellKind::hexahedron ? eight : six;
}

double raised_coordinates(const QuadraticMesh &mesh, double n)
{
  const auto count = [](const auto &cells) { return static_cast<double>(cells.size()); };
  return n + 3. * (3.5 * count(mesh.cells) + 16. * count(mesh.hexahedra) + 9.5 * count(mesh.prisms));
}

RaisedFrame raise_degree(const QuadraticMesh &mesh, const CellMaterials &materials, const AffineConstraints &affine,
                         const SparseMatrix &C, const SparseMatrix &M)
{
  const CubicFunctions    cubics(mesh);
  const AffineConstraints raised(with_cubics(affine, cubics));
  RaisedFrame             result;
  for (int i = 0; i < affine.n_coordinates(); ++i)
    result.place.push_back(i < affine.n_free() ? i : i + raised.n_free() - affine.n_free());
  RaisedCells cells(mesh, cubics);
  const auto  matrices = [&](int cell) -> CellMatrices
  {
    const PointValues &at = cells.of(cell);
    return {tangent_stiffness(at, mesh, materials, cell), mass_matrix(at, materials[cell].rho)};
  };
  MatrixSums sums = raised.sum(
      whole(mesh, raised), [&](int cell) { return cells.nodes(cell); }, matrices);
  result.C = with_frame(std::move(sums.C), C, result.place);
  result.M = with_frame(std::move(sums.M), M, result.place);
  return result;
}

} // namespace gestell::fem
