#include "fem/assembly/raised_degree.h"

#include "fem/assembly/reference_cell.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

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
    (cell_.nodes.xi.colwise() - xi).colwise().norm().minCoeff(&node);
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
      if (const Eigen::Vector3d xi = cell_.nodes.xi.col(node); std::abs(xi[d] - 0.5) < 0.1)
      {
        const Eigen::Vector3d half = 0.5 * Eigen::Vector3d::Unit(d);
        functions.push_back({node, line, {node_at(xi - half), node, node_at(xi + half)}, true, {node}});
      }
  }
  const ReferenceCell &cell_;
};

/// Quadratics and cubics of the reference cell at a point of a rule.
struct Point
{
  double                       weight;
  Eigen::VectorXd              N;  // [n]
  Eigen::Matrix<double, -1, 3> dN; // [n x 3]
};

Point with_cubics(const ReferenceCell::Points &points, int p, const std::vector<Local> &functions)
{
  const auto                         n = points.N.rows(), m = Eigen::Index(functions.size());
  const Eigen::VectorXd              N  = points.N.col(p);
  const Eigen::Matrix<double, -1, 3> dN = points.dN.middleCols<3>(3 * p);
  Point point{points.weight[p], Eigen::VectorXd(n + m), Eigen::Matrix<double, -1, 3>(n + m, 3)};
  point.N.head(n)     = N;
  point.dN.topRows(n) = dN;
  for (Eigen::Index k = 0; k < m; ++k)
  {
    const auto  &own    = functions[k];
    const double l      = own.line[0] + own.line.tail<3>().dot(points.xi.col(p));
    point.N[n + k]      = l * N[own.amid];
    point.dN.row(n + k) = l * dN.row(own.amid) + N[own.amid] * own.line.tail<3>().transpose();
  }
  return point;
}

/// Quadrature, exact for the stiffness of straight cells and nearly so for the mass, with small cubic terms.
std::vector<Point> rule(CellKind kind, const std::vector<Local> &functions)
{
  const ReferenceCell::Points &finer = reference_cell(kind).finer;
  std::vector<Point>           points;
  for (int p = 0; p < finer.size(); ++p)
    points.push_back(with_cubics(finer, p, functions));
  return points;
}

struct CellMatrices
{
  Eigen::Matrix<double, -1, -1, Eigen::RowMajor> C, M; // [3 n x 3 n], [n x n]
};

CellMatrices cell_matrices(const Eigen::Matrix3Xd &X, const std::vector<Point> &points, const Material &material)
{
  const auto      n = points.front().N.size(), n_points = Eigen::Index(points.size()), n_nodes = X.cols();
  Eigen::MatrixXd gradients(3 * n, n_points), values(n, n_points);
  for (Eigen::Index p = 0; p < n_points; ++p)
  {
    const Point           &point = points[p];
    const Eigen::Matrix3d  J     = X * point.dN.topRows(n_nodes);
    const double           root  = std::sqrt(point.weight * std::abs(J.determinant()));
    const Eigen::Matrix3Xd G     = root * (point.dN * J.inverse()).transpose();
    gradients.col(p)             = G.reshaped();
    values.col(p)                = root * point.N;
  }
  CellMatrices          result;
  const Eigen::MatrixXd D      = gradients * gradients.transpose(); // blocks int grad N_a grad N_b^T dV
  const double          lambda = material.E * material.nu / ((1. + material.nu) * (1. - 2. * material.nu));
  const double          mu     = material.E / (2. * (1. + material.nu));
  result.M                     = material.rho * (values * values.transpose());
  result.C.resize(3 * n, 3 * n);
  for (Eigen::Index a = 0; a < n; ++a)
    for (Eigen::Index b = 0; b < n; ++b)
    {
      const Eigen::Matrix3d own = D.block<3, 3>(3 * a, 3 * b);
      result.C.block<3, 3>(3 * a, 3 * b) =
          lambda * own + mu * own.transpose() + mu * own.trace() * Eigen::Matrix3d::Identity();
    }
  return result;
}

/// Adds functions as further nodes after those of the mesh.
class ExtendedFrame
{
public:
  ExtendedFrame(const QuadraticMesh &mesh, const AffineConstraints &affine)
      : mesh_(mesh), functions_(mesh), lists_(lists_of(mesh, affine))
  {
    n_free_ = lists_.n_free;
    for (int &column : lists_.tie_column)
      column = shifted(column);
    place_.assign(affine.n_coordinates(), -1);
    for (std::size_t k = 0; k < lists_.coordinates.size(); ++k)
      place_[lists_.coordinates[k]] = int(k);
    int n = int(lists_.coordinates.size());
    for (int &place : place_) // of coordinates that move no node
      place = shifted(place < 0 ? n++ : place);
    n_added_ = 0;
    extend(affine);
    for (int &column : lists_.tie_column)
      column = column < 0 ? -1 - column + n_added_ : column;
    for (int &place : place_)
      place = place < 0 ? -1 - place + n_added_ : place;
    lists_.n_free        = n_free_ + n_added_;
    lists_.n_coordinates = n + n_added_;
  }

  RaisedFrame frame(const CellMaterials &materials, const SparseMatrix &C, const SparseMatrix &M) const
  {
    const CellKind   all[] = {CellKind::tetrahedron, CellKind::hexahedron, CellKind::prism};
    std::vector<int> begin, nodes; // of the cells with the functions as further nodes
    for (int cell = 0; cell < mesh_.n_cells(); ++cell)
    {
      begin.push_back(static_cast<int>(nodes.size()));
      nodes.insert(nodes.end(), mesh_.nodes(cell), mesh_.nodes(cell) + mesh_.n_nodes_of(cell));
      for (const auto &number : functions_.numbers(cell))
        nodes.push_back(mesh_.n_nodes() + number.first);
    }
    begin.push_back(static_cast<int>(nodes.size()));
    std::vector<NodeLists>                 lists;
    std::map<CellKind, std::vector<Point>> points;
    for (const CellKind kind : all)
      points[kind] = rule(kind, functions_.of_cell(kind));
    for (int cell = 0; cell < mesh_.n_cells(); ++cell)
      lists.push_back({&nodes[begin[cell]], 1, begin[cell + 1] - begin[cell]});

    const int   n_all = mesh_.n_nodes() + functions_.size();
    BlockMatrix C_cells(3, n_all, lists), M_cells(1, n_all, lists);
    for (int cell = 0; cell < mesh_.n_cells(); ++cell)
    {
      CellMatrices own = cell_matrices(positions(mesh_, cell), points[mesh_.kind(cell)], materials[cell]);
      turn(functions_.numbers(cell), mesh_.n_nodes_of(cell), own);
      C_cells.add(lists[cell].nodes, lists[cell].n_nodes, own.C.data());
      M_cells.add(lists[cell].nodes, lists[cell].n_nodes, own.M.data());
    }
    C_cells.finish();
    M_cells.finish();
    SparseMatrix all_C = extended(std::move(C_cells), C);
    return {std::move(all_C), extended(std::move(M_cells), M), place_};
  }

private:
  static AffineConstraints::Lists lists_of(const QuadraticMesh &mesh, const AffineConstraints &affine)
  {
    std::vector<int> nodes(mesh.n_nodes());
    std::iota(nodes.begin(), nodes.end(), 0);
    return affine.of_nodes(nodes);
  }
  /// Marks coordinates that move up for the functions, whose number is not yet known.
  int shifted(int coordinate) const { return coordinate < n_free_ ? coordinate : -1 - coordinate; }

  void extend(const AffineConstraints &affine)
  {
    for (int k = 0; k < functions_.size(); ++k)
      for (int d = 0; d < 3; ++d)
      {
        const auto &with = functions_.vanish_with(k);
        const bool  held =
            std::all_of(with.begin(), with.end(), [&](int node) { return affine.coordinate(3 * node + d) < 0; });
        lists_.column.push_back(held ? -1 : n_free_ + n_added_++);
        lists_.tied_row.push_back(-1);
      }
  }

  bool is_added(Eigen::Index i) const { return i >= n_free_ && i < n_free_ + n_added_; }

  /// What the cells add to A, the matrix of the frame, in its coordinates. Computed in place: a copy would be the
  /// largest object in memory.
  SparseMatrix extended(BlockMatrix cells, const SparseMatrix &A) const
  {
    SparseMatrix sum = projected(std::move(cells));
    for (Eigen::Index j = 0; j < sum.cols(); ++j)
      for (SparseMatrix::InnerIterator entry(sum, j); entry; ++entry)
        if (!is_added(entry.row()) && !is_added(j))
          entry.valueRef() = 0.;
    SparseMatrix beyond(sum.rows(), sum.cols()); // masses and foundations that join what no cell does
    for (Eigen::Index i = 0; i < A.cols(); ++i)
      replace(A, i, sum, beyond);
    if (beyond.nonZeros() > 0)
      sum += beyond;
    return sum;
  }

  /// The cells' matrix is not needed any more.
  SparseMatrix projected(BlockMatrix cells) const { return AffineConstraints(lists_).project(cells); }

  /// The numbers of column i of A at their places.
  void replace(const SparseMatrix &A, Eigen::Index i, SparseMatrix &sum, SparseMatrix &beyond) const
  {
    const int *const begin = sum.innerIndexPtr() + sum.outerIndexPtr()[place_[i]],
                     *end  = sum.innerIndexPtr() + sum.outerIndexPtr()[place_[i] + 1];
    for (SparseMatrix::InnerIterator a(A, i); a; ++a)
    {
      const int *const at = std::lower_bound(begin, end, place_[a.row()]);
      if (at != end && *at == place_[a.row()])
        sum.valuePtr()[at - sum.innerIndexPtr()] = a.value();
      else
        beyond.coeffRef(place_[a.row()], place_[i]) = a.value();
    }
  }

  /// Functions that the cell counts against their direction.
  static void turn(const std::vector<std::pair<int, double>> &numbers, int n_nodes, CellMatrices &own)
  {
    for (std::size_t k = 0; k < numbers.size(); ++k)
      if (numbers[k].second < 0.)
      {
        const Eigen::Index i = n_nodes + Eigen::Index(k);
        own.C.middleRows<3>(3 * i) *= -1.;
        own.C.middleCols<3>(3 * i) *= -1.;
        own.M.row(i) *= -1.;
        own.M.col(i) *= -1.;
      }
  }

  const QuadraticMesh     &mesh_;
  CubicFunctions           functions_;
  AffineConstraints::Lists lists_;
  std::vector<int>         place_;
  int                      n_free_ = 0, n_added_ = 0;
};

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
  return ExtendedFrame(mesh, affine).frame(materials, C, M);
}

} // namespace gestell::fem
