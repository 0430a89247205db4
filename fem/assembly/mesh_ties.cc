#include "fem/assembly/mesh_ties.h"

#include "fem/assembly/face_rules.h"
#include "fem/assembly/reference_cell.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>

namespace gestell::fem
{

namespace
{

using Vector27 = Eigen::Matrix<double, 27, 1>;

Eigen::Map<const Eigen::Vector3d> point_of(const QuadraticMesh &mesh, int node)
{
  return Eigen::Map<const Eigen::Vector3d>(mesh.points[node].data());
}

/// The functions of a hexahedron, products of parabolas, or their derivatives along one direction of the cell.
Vector27 functions_at(const Eigen::Vector3d &xi, int along = -1)
{
  static const Eigen::Matrix3Xd nodes = reference_cell(CellKind::hexahedron).nodes;
  Vector27                      N     = Vector27::Ones();
  for (int d = 0; d < 3; ++d)
  {
    const double x = xi[d], value[] = {(1. - 2. * x) * (1. - x), 4. * x * (1. - x), x * (2. * x - 1.)},
                 slope[] = {4. * x - 3., 4. - 8. * x, 4. * x - 1.};
    for (int a = 0; a < 27; ++a)
      N[a] *= (d == along ? slope : value)[std::lround(2. * nodes(d, a))];
  }
  return N;
}

/// A hexahedron with straight edges, and the place of points in it.
class Hexahedron
{
public:
  Hexahedron(const QuadraticMesh &mesh, int cell)
  {
    for (int k = 0; k < 8; ++k)
    {
      corners_.col(k) = point_of(mesh, mesh.nodes(cell)[k]);
      box_.extend(Eigen::Vector3d(corners_.col(k)));
    }
    origin_ = corners_.col(0);
    corners_.colwise() -= origin_; // far from the origin rounding would stop Newton's method
    for (int d = 0; d < 3; ++d)
      length_[d] = derivatives(Eigen::Vector3d::Constant(0.5)).col(d).norm();
  }

  double distance_of_box(const Eigen::Vector3d &x) const { return box_.exteriorDistance(x); }

  /// Newton's method from the middle; none if it does not converge, as for some points outside.
  std::optional<Eigen::Vector3d> place(const Eigen::Vector3d &x) const
  {
    Eigen::Vector3d  xi        = Eigen::Vector3d::Constant(0.5);
    constexpr int    most      = 20;
    constexpr double converged = 1e-12, on_face = 1e-11; // functions that vanish on a face do so exactly
    for (int i = 0; i < most; ++i)
    {
      const Eigen::Vector3d step = derivatives(xi).partialPivLu().solve(x - origin_ - at(xi));
      xi += step;
      if (step.cwiseAbs().maxCoeff() < converged)
        return xi.unaryExpr([](double c) { return std::abs(c - std::round(c)) < on_face ? std::round(c) : c; });
    }
    return std::nullopt;
  }

  /// By which a place is beyond the cell [m].
  double beyond(const Eigen::Vector3d &xi) const
  {
    const Eigen::Vector3d out = (-xi).cwiseMax(xi.array().matrix() - Eigen::Vector3d::Ones()).cwiseMax(0.);
    return out.cwiseProduct(length_).norm();
  }

  Eigen::Matrix3d derivatives(const Eigen::Vector3d &xi) const
  {
    Eigen::Matrix3d J = Eigen::Matrix3d::Zero();
    for (int k = 0; k < 8; ++k)
      for (int d = 0; d < 3; ++d)
      {
        const int e = (d + 1) % 3, f = (d + 2) % 3;
        J.col(d) += ((k >> d) & 1 ? 1. : -1.) * along(k, e, xi[e]) * along(k, f, xi[f]) * corners_.col(k);
      }
    return J;
  }

private:
  /// Corner k is at the bits of k.
  static double along(int k, int d, double x) { return (k >> d) & 1 ? x : 1. - x; }

  Eigen::Vector3d at(const Eigen::Vector3d &xi) const
  {
    Eigen::Vector3d x = Eigen::Vector3d::Zero();
    for (int k = 0; k < 8; ++k)
      x += along(k, 0, xi[0]) * along(k, 1, xi[1]) * along(k, 2, xi[2]) * corners_.col(k);
    return x;
  }

  Eigen::Vector3d             origin_;
  Eigen::Matrix<double, 3, 8> corners_; ///< from the origin_
  Eigen::AlignedBox3d         box_;
  Eigen::Vector3d             length_;
};

/// Finds the cell that leads at a point.
class Leaders
{
public:
  Leaders(const QuadraticMesh &mesh, const QuadraticTie &tie) : solids_(tie.solids), cells_(tie.cells)
  {
    for (const int cell : tie.cells)
    {
      if (mesh.kind(cell) != CellKind::hexahedron)
        throw std::invalid_argument("mesh_ties: only hexahedra lead");
      shapes_.emplace_back(mesh, cell);
    }
    if (shapes_.empty())
      throw std::invalid_argument("mesh_ties: solid \"" + tie.solids[0] + "\" meets no cell of \"" + tie.solids[1] +
                                  "\"");
  }

  void find(const Eigen::Vector3d &x, TiedPoint &point) const
  {
    std::size_t     own = 0;
    Eigen::Vector3d xi  = Eigen::Vector3d::Zero();
    point.gap           = nowhere;
    for (std::size_t i = 0; i < shapes_.size() && point.gap > 0.; ++i)
      if (shapes_[i].distance_of_box(x) < point.gap)
        if (const auto place = shapes_[i].place(x); place && shapes_[i].beyond(*place) < point.gap)
        {
          point.gap = shapes_[i].beyond(*place);
          own       = i;
          xi        = *place;
        }
    if (!(point.gap < nowhere))
    {
      std::ostringstream message;
      message << "solids \"" << solids_[0] << "\" and \"" << solids_[1]
              << "\" cannot be tied: no element contains the point (" << x.transpose()
              << ") m; give the surface between them a smaller size";
      throw std::runtime_error(message.str());
    }
    point.cell    = cells_[own];
    point.leading = functions_at(xi);
    Eigen::Matrix<double, 27, 3> local;
    for (int d = 0; d < 3; ++d)
      local.col(d) = functions_at(xi, d);
    point.leading_gradients = local * shapes_[own].derivatives(xi).inverse();
  }

private:
  static constexpr double nowhere = 1e300; ///< gap [m] before a place is found

  std::array<std::string, 2> solids_;
  const std::vector<int>    &cells_;
  std::vector<Hexahedron>    shapes_;
};

template <std::size_t n>
void add_points(const QuadraticMesh &mesh, const std::array<int, n> &face, const std::vector<FacePoint<int(n)>> &rule,
                const Leaders &leaders, std::vector<TiedPoint> &points)
{
  Eigen::Matrix<double, 3, int(n)> X;
  for (std::size_t a = 0; a < n; ++a)
    X.col(a) = point_of(mesh, face[a]);
  for (const auto &at : rule)
  {
    const Eigen::Matrix<double, 3, 2> tangents = X * at.dN;
    const Eigen::Vector3d             across = Eigen::Vector3d(tangents.col(0)).cross(Eigen::Vector3d(tangents.col(1)));
    TiedPoint                         point;
    point.area   = at.weight * across.norm();
    point.normal = across.normalized();
    point.nodes.assign(face.begin(), face.end());
    point.N = at.N;
    leaders.find(X * at.N, point);
    points.push_back(std::move(point));
  }
}

/// Numbers of nodes in the order in which they come.
class Numbers
{
public:
  int of(int node)
  {
    const auto [entry, is_new] = number_.try_emplace(node, static_cast<int>(nodes_.size()));
    if (is_new)
      nodes_.push_back(node);
    return entry->second;
  }
  const std::vector<int> &nodes() const { return nodes_; }

private:
  std::map<int, int> number_;
  std::vector<int>   nodes_;
};

/// Integrals of a tie:  D = int phi phi^T,  L = int phi N^T.
struct TieIntegrals
{
  std::vector<int> following, leading; ///< nodes
  Eigen::MatrixXd  D, L;
};

TieIntegrals integrals_of(const QuadraticMesh &mesh, const std::vector<TiedPoint> &points)
{
  Numbers following, leading;
  for (const TiedPoint &point : points)
  {
    for (const int node : point.nodes)
      following.of(node);
    for (int a = 0; a < 27; ++a)
      leading.of(mesh.nodes(point.cell)[a]);
  }
  const auto   n = Eigen::Index(following.nodes().size()), m = Eigen::Index(leading.nodes().size());
  TieIntegrals result{following.nodes(), leading.nodes(), Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, m)};
  for (const TiedPoint &point : points)
    for (Eigen::Index i = 0; i < point.N.size(); ++i)
    {
      const int row = following.of(point.nodes[i]);
      for (Eigen::Index j = 0; j < point.N.size(); ++j)
        result.D(row, following.of(point.nodes[j])) += point.area * point.N[i] * point.N[j];
      for (int a = 0; a < 27; ++a)
        result.L(row, leading.of(mesh.nodes(point.cell)[a])) += point.area * point.N[i] * point.leading[a];
    }
  return result;
}

/// One direction of a tie.
void tie_along(int d, const TieIntegrals &of, const std::set<int> &excluded, MultipointConstraints &constraints)
{
  std::vector<int> free, known; // among the following
  for (std::size_t i = 0; i < of.following.size(); ++i)
  {
    const int  node = of.following[i], displacement = 3 * node + d;
    const bool is_free =
        !constraints.held[displacement] && constraints.tie_of[displacement] < 0 && excluded.count(node) == 0;
    (is_free ? free : known).push_back(static_cast<int>(i));
  }
  if (free.empty())
    return;
  const Eigen::LDLT<Eigen::MatrixXd> D(Eigen::MatrixXd(of.D(free, free)));
  const Eigen::MatrixXd              W = D.solve(Eigen::MatrixXd(of.L(free, Eigen::all))),
                        V              = D.solve(Eigen::MatrixXd(of.D(free, known)));
  constexpr double rounding            = 1e-15;
  for (std::size_t i = 0; i < free.size(); ++i)
  {
    Combination combination;
    for (std::size_t j = 0; j < of.leading.size(); ++j)
      if (const double w = W(Eigen::Index(i), Eigen::Index(j)); std::abs(w) > rounding)
        combination.emplace_back(3 * of.leading[j] + d, w);
    for (std::size_t j = 0; j < known.size(); ++j)
      if (const double v = V(Eigen::Index(i), Eigen::Index(j)); std::abs(v) > rounding)
        combination.emplace_back(3 * of.following[known[j]] + d, -v);
    constraints.tie(3 * of.following[free[i]] + d, std::move(combination));
  }
}

} // namespace

std::vector<TiedPoint> tied_points(const QuadraticMesh &mesh, const QuadraticTie &tie)
{
  const Leaders          leaders(mesh, tie);
  std::vector<TiedPoint> points;
  for (const auto &face : tie.triangles)
    add_points(mesh, face, fine_face_rules().triangle, leaders, points);
  for (const auto &face : tie.quads)
    add_points(mesh, face, fine_face_rules().quadrilateral, leaders, points);
  return points;
}

void tie_meshes(const QuadraticMesh &mesh, const std::set<int> &excluded, MultipointConstraints &constraints)
{
  for (const QuadraticTie &tie : mesh.ties)
  {
    const TieIntegrals of = integrals_of(mesh, tied_points(mesh, tie));
    for (int d = 0; d < 3; ++d)
      tie_along(d, of, excluded, constraints);
  }
}

double tie_work(const QuadraticMesh &mesh, const std::vector<TiedPoint> &points, const CellMaterials &materials,
                const Eigen::VectorXd &u)
{
  double work = 0.;
  for (const TiedPoint &point : points)
  {
    Eigen::Vector3d jump = Eigen::Vector3d::Zero();
    Eigen::Matrix3d H    = Eigen::Matrix3d::Zero(); // du_i / dx_j
    for (Eigen::Index i = 0; i < point.N.size(); ++i)
      jump += point.N[i] * u.segment<3>(3 * point.nodes[i]);
    for (int a = 0; a < 27; ++a)
    {
      const Eigen::Vector3d own = u.segment<3>(3 * mesh.nodes(point.cell)[a]);
      jump -= point.leading[a] * own;
      H += own * point.leading_gradients.row(a);
    }
    const Material &material = materials[point.cell];
    const double    lambda   = material.E * material.nu / ((1. + material.nu) * (1. - 2. * material.nu)),
                 mu          = material.E / (2. * (1. + material.nu));
    work += point.area * (lambda * H.trace() * point.normal + mu * (H + H.transpose()) * point.normal).dot(jump);
  }
  return std::abs(work);
}

} // namespace gestell::fem
