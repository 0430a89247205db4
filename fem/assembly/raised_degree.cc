#include "fem/assembly/raised_degree.h"

#include "fem/assembly/elasticity.h"
#include "fem/assembly/reference_cell.h"
#include "fem/mesh/hexahedron.h"

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

/// L_i of the corners as linear functions of xi.
Eigen::Vector4d barycentric(int corner)
{
  Eigen::Vector4d line = Eigen::Vector4d::Zero();
  if (corner == 0)
    line << 1., -1., -1., -1.;
  else
    line[corner] = 1.;
  return line;
}

std::vector<Local> of_tetrahedron(const ReferenceCell &cell)
{
  std::vector<Local> functions;
  const auto         amid = [&](int a, int b)
  {
    for (int node = 4; node < cell.n_nodes; ++node)
      if (const auto &of = cell.between[node]; std::minmax(a, b) == std::minmax(of[0], of[1]))
        return node;
    return -1;
  };
  for (int a = 0; a < 4; ++a)
    for (int b = a + 1; b < 4; ++b)
    {
      const int middle = amid(a, b);
      functions.push_back({middle, barycentric(a) - barycentric(b), {a, middle, b}, true, {middle}});
    }
  for (int out = 0; out < 4; ++out)
  {
    const int a = (out + 1) % 4, b = (out + 2) % 4, c = (out + 3) % 4;
    functions.push_back({amid(a, b),
                         barycentric(c),
                         {amid(a, b), amid(b, c), amid(c, a)},
                         false,
                         {amid(a, b), amid(b, c), amid(c, a)}});
  }
  return functions;
}

std::vector<Local> of_hexahedron()
{
  std::vector<Local> functions;
  for (int node = 0; node < hexahedron::n_nodes; ++node)
    for (int d = 0, stride = 1; d < 3; ++d, stride *= 3)
      if (node / stride % 3 == 1)
      {
        Eigen::Vector4d line = Eigen::Vector4d::Zero();
        line[d + 1]          = 1.;
        functions.push_back({node, line, {node - stride, node, node + stride}, true, {node}});
      }
  return functions;
}

/// Quadratics and cubics of the reference cell at a point of a rule.
struct Point
{
  double                       weight;
  Eigen::VectorXd              N;  // [n]
  Eigen::Matrix<double, -1, 3> dN; // [n x 3]
};

Point with_cubics(double weight, const Eigen::VectorXd &N, const Eigen::Matrix<double, -1, 3> &dN,
                  const Eigen::Vector3d &xi, const std::vector<Local> &functions)
{
  const auto n = N.size(), m = Eigen::Index(functions.size());
  Point      point{weight, Eigen::VectorXd(n + m), Eigen::Matrix<double, -1, 3>(n + m, 3)};
  point.N.head(n)     = N;
  point.dN.topRows(n) = dN;
  for (Eigen::Index k = 0; k < m; ++k)
  {
    const auto  &own    = functions[k];
    const double l      = own.line[0] + own.line.tail<3>().dot(xi);
    point.N[n + k]      = l * N[own.amid];
    point.dN.row(n + k) = l * dN.row(own.amid) + N[own.amid] * own.line.tail<3>().transpose();
  }
  return point;
}

/// Exact for the stiffness of straight cells; of masses, whose cubics carry next to nothing, nearly so.
std::vector<Point> rule(const QuadraticMesh &mesh, const std::vector<Local> &functions)
{
  std::vector<Point> points;
  if (!mesh.hexahedra.empty())
    for (const auto &point : hexahedron::quadrature(4))
      points.push_back(with_cubics(point.weight, point.N, point.dN, point.xi, functions));
  else
    for (const auto &[weight, N, dN] : reference_integrals().tetrahedron)
    {
      const Eigen::Vector3d xi(0.25 * (dN(1, 0) + 1.), 0.25 * (dN(2, 1) + 1.), 0.25 * (dN(3, 2) + 1.)); // L_1, L_2, L_3
      points.push_back(with_cubics(weight, N, dN, xi, functions));
    }
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

/// Functions as further nodes behind those of the mesh.
class ExtendedFrame
{
public:
  ExtendedFrame(const QuadraticMesh &mesh, const Kinematics &kinematics)
      : mesh_(mesh), functions_(mesh), lists_(lists_of(mesh, kinematics))
  {
    n_free_ = lists_.n_free;
    for (int &column : lists_.tie_column)
      column = shifted(column);
    place_.assign(kinematics.n_coordinates(), -1);
    for (std::size_t k = 0; k < lists_.coordinates.size(); ++k)
      place_[lists_.coordinates[k]] = int(k);
    int n = int(lists_.coordinates.size());
    for (int &place : place_) // of coordinates that move no node
      place = shifted(place < 0 ? n++ : place);
    n_added_ = 0;
    extend(kinematics);
    for (int &column : lists_.tie_column)
      column = column < 0 ? -1 - column + n_added_ : column;
    for (int &place : place_)
      place = place < 0 ? -1 - place + n_added_ : place;
    lists_.n_free        = n_free_ + n_added_;
    lists_.n_coordinates = n + n_added_;
  }

  RaisedFrame frame(const CellMaterials &materials, const SparseMatrix &C, const SparseMatrix &M) const
  {
    return mesh_.hexahedra.empty() ? assembled<20>(materials, C, M) : assembled<54>(materials, C, M);
  }

private:
  static Kinematics::Lists lists_of(const QuadraticMesh &mesh, const Kinematics &kinematics)
  {
    std::vector<int> nodes(mesh.n_nodes());
    std::iota(nodes.begin(), nodes.end(), 0);
    return kinematics.of_nodes(nodes);
  }
  /// Marks what moves up to make room for the functions, whose number is not known yet.
  int shifted(int coordinate) const { return coordinate < n_free_ ? coordinate : -1 - coordinate; }

  void extend(const Kinematics &kinematics)
  {
    for (int k = 0; k < functions_.size(); ++k)
      for (int d = 0; d < 3; ++d)
      {
        const auto &with = functions_.vanish_with(k);
        const bool  held =
            std::all_of(with.begin(), with.end(), [&](int node) { return kinematics.coordinate(3 * node + d) < 0; });
        lists_.column.push_back(held ? -1 : n_free_ + n_added_++);
        lists_.tied_row.push_back(-1);
      }
  }

  bool is_added(Eigen::Index i) const { return i >= n_free_ && i < n_free_ + n_added_; }

  /// What the cells add beside A, the frame's own, in its coordinates.  In place: with copies it would be the largest
  /// thing in memory.
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
  SparseMatrix projected(BlockMatrix cells) const { return Kinematics(lists_).project(cells); }

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

  template <std::size_t n>
  RaisedFrame assembled(const CellMaterials &materials, const SparseMatrix &C, const SparseMatrix &M) const
  {
    const auto                      points  = rule(mesh_, functions_.of_cell());
    const int                       n_nodes = mesh_.nodes_per_cell(), n_all = mesh_.n_nodes() + functions_.size();
    std::vector<std::array<int, n>> cells(mesh_.n_cells());
    for (int cell = 0; cell < mesh_.n_cells(); ++cell)
    {
      std::copy_n(mesh_.nodes(cell), n_nodes, cells[cell].begin());
      std::transform(functions_.numbers(cell).begin(), functions_.numbers(cell).end(), cells[cell].begin() + n_nodes,
                     [&](const auto &number) { return mesh_.n_nodes() + number.first; });
    }
    BlockMatrix C_cells(3, n_all, cells), M_cells(1, n_all, cells);
    for (int cell = 0; cell < mesh_.n_cells(); ++cell)
    {
      CellMatrices own = cell_matrices(positions(mesh_, cell), points, materials[cell]);
      for (std::size_t k = n_nodes; k < n; ++k)
        if (functions_.numbers(cell)[k - n_nodes].second < 0.)
        {
          own.C.middleRows<3>(3 * k) *= -1.;
          own.C.middleCols<3>(3 * k) *= -1.;
          own.M.row(k) *= -1.;
          own.M.col(k) *= -1.;
        }
      C_cells.add(cells[cell], own.C.data());
      M_cells.add(cells[cell], own.M.data());
    }
    C_cells.finish();
    M_cells.finish();
    SparseMatrix all_C = extended(std::move(C_cells), C);
    return {std::move(all_C), extended(std::move(M_cells), M), place_};
  }

  const QuadraticMesh &mesh_;
  CubicFunctions       functions_;
  Kinematics::Lists    lists_;
  std::vector<int>     place_;
  int                  n_free_ = 0, n_added_ = 0;
};

} // namespace

CubicFunctions::CubicFunctions(const QuadraticMesh &mesh)
    : local_(mesh.hexahedra.empty() ? of_tetrahedron(reference_cell(mesh)) : of_hexahedron()), numbers_(mesh.n_cells())
{
  std::map<std::array<int, 3>, int> known;
  for (int cell = 0; cell < mesh.n_cells(); ++cell)
    for (const Local &own : local_)
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

double raised_coordinates(const QuadraticMesh &mesh, double n)
{
  return n + 3. * (mesh.hexahedra.empty() ? 3.5 : 16.) * mesh.n_cells();
}

RaisedFrame raise_degree(const QuadraticMesh &mesh, const CellMaterials &materials, const Kinematics &kinematics,
                         const SparseMatrix &C, const SparseMatrix &M)
{
  return ExtendedFrame(mesh, kinematics).frame(materials, C, M);
}

} // namespace gestell::fem
