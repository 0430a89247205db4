#include "fem/assembly/cut_force.h"

#include "fem/assembly/elasticity.h"
#include "fem/assembly/reference_cell.h"
#include "fem/assembly/rigid_motions.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace gestell::fem
{

namespace
{

using Eigen::Vector3d;
using Motions = Eigen::Matrix<double, 3, 6>; // of a point, for each of the six components

std::string head(const CutSpecification &cut)
{
  const std::string owner = "cut \"" + cut.name + "\"";
  return cut.place.empty() ? owner : cut.place + ": " + owner;
}

Vector3d vector_of(const Vector3 &x)
{
  return Vector3d(x[0], x[1], x[2]);
}

/// A plane through the frame, and how far above it points lie.
struct Plane
{
  Vector3d through, normal;

  double height(const Vector3d &x) const { return normal.dot(x - through); }
};

Plane plane_of(const CutSpecification &cut)
{
  const Vector3d normal = vector_of(cut.normal);
  if (!(normal.norm() > 0.) || !normal.allFinite())
    throw std::invalid_argument(head(cut) + ": the normal is zero; give three numbers such as [0, 0, 1].");
  return {vector_of(cut.through), normal.normalized()};
}

/// Columns n, e_1, e_2.
Eigen::Matrix3d axes_of(const CutSpecification &cut, const Vector3d &normal)
{
  Eigen::Index nearest;
  normal.cwiseAbs().maxCoeff(&nearest);
  const Vector3d   first = cut.first ? vector_of(*cut.first).normalized() : Vector3d::Unit((nearest + 1) % 3);
  const Vector3d   e     = first - first.dot(normal) * normal;
  constexpr double along = 1e-3; // below it the direction of e is the error of a normal given with few digits
  if (!(e.norm() > along))
    throw std::invalid_argument(head(cut) +
                                ": the first direction is parallel to the normal; give a direction in the plane.");
  Eigen::Matrix3d axes;
  axes << normal, e.normalized(), normal.cross(e.normalized());
  return axes;
}

/// Distance of the centroid of every cell from the plane, positive where the normal points.
std::vector<double> heights(const Plane &plane, const QuadraticMesh &mesh)
{
  std::vector<double> result;
  result.reserve(mesh.n_cells());
  for (int cell = 0; cell < mesh.n_cells(); ++cell)
  {
    Vector3d  centroid  = Vector3d::Zero();
    const int n_corners = reference_cell(mesh.kind(cell)).n_corners;
    for (int k = 0; k < n_corners; ++k)
      centroid += vector_of(mesh.points[mesh.nodes(cell)[k]]);
    result.push_back(plane.height(centroid / static_cast<double>(n_corners)));
  }
  return result;
}

/// Part of the cells above a plane, and their section.
struct Slice
{
  double          volume = 0., above = 0., area = 0.;
  Vector3d        moment = Vector3d::Zero(), area_moment = Vector3d::Zero(); // int x dV above, int x dA
  Vector3d        origin = Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero(); // int (x - x_o) (x - x_o)^T dV above

  void add(const Plane &plane, std::array<Vector3d, 4> x);

private:
  void take(double sign, const Vector3d &a, const Vector3d &b, const Vector3d &c, const Vector3d &d)
  {
    const double V = sign * std::abs((b - a).cross(c - a).dot(d - a)) / 6.;
    above += V;
    moment += V * (a + b + c + d) / 4.;
    Eigen::Matrix<double, 3, 5> r;
    r << a - origin, b - origin, c - origin, d - origin, a + b + c + d - 4. * origin;
    second += V / 20. * r * r.transpose();
  }
  void cut(const Vector3d &a, const Vector3d &b, const Vector3d &c)
  {
    const double A = 0.5 * (b - a).cross(c - a).norm();
    area += A;
    area_moment += A * (a + b + c) / 3.;
  }
};

/// A tetrahedron.
void Slice::add(const Plane &plane, std::array<Vector3d, 4> x)
{
  std::sort(x.begin(), x.end(),
            [&](const Vector3d &a, const Vector3d &b) { return plane.height(a) > plane.height(b); });
  const auto at = [&](int i, int j) -> Vector3d // of the edge
  {
    const double h = plane.height(x[i]);
    return x[i] + h / (h - plane.height(x[j])) * (x[j] - x[i]);
  };
  volume += std::abs((x[1] - x[0]).cross(x[2] - x[0]).dot(x[3] - x[0])) / 6.;
  switch (std::count_if(x.begin(), x.end(), [&](const Vector3d &a) { return plane.height(a) > 0.; }))
  {
  case 0:
    return;
  case 1:
    take(1., x[0], at(0, 1), at(0, 2), at(0, 3));
    return cut(at(0, 1), at(0, 2), at(0, 3));
  case 2: // a prism, by three tetrahedra
    take(1., x[0], at(0, 2), at(0, 3), x[1]);
    take(1., at(0, 2), at(0, 3), x[1], at(1, 2));
    take(1., at(0, 3), x[1], at(1, 2), at(1, 3));
    cut(at(0, 2), at(0, 3), at(1, 3));
    return cut(at(0, 2), at(1, 3), at(1, 2));
  case 3:
    take(1., x[0], x[1], x[2], x[3]);
    take(-1., x[3], at(0, 3), at(1, 3), at(2, 3));
    return cut(at(0, 3), at(1, 3), at(2, 3));
  default:
    take(1., x[0], x[1], x[2], x[3]);
  }
}

/// Adds a cell, taken as straight.
void add(Slice &slice, const Plane &plane, const QuadraticMesh &mesh, int cell)
{
  std::vector<Vector3d> x;
  for (const int k : reference_cell(mesh.kind(cell)).node_of_corner)
    x.push_back(vector_of(mesh.points[mesh.nodes(cell)[k]]));
  for (const auto &[a, b, c, d] : cell_shape(mesh.kind(cell)).pieces)
    slice.add(plane, {x[a], x[b], x[c], x[d]});
}

/// Centroid of the section.
Vector3d centroid(const Plane &plane, const QuadraticMesh &mesh)
{
  Slice section;
  for (int cell = 0; cell < mesh.n_cells(); ++cell)
    add(section, plane, mesh, cell);
  return section.area > 0. ? Vector3d(section.area_moment / section.area) : plane.through;
}

/// The six motions v of the nodes: w(x) above, zero below; tied nodes follow those they are tied to.
class MotionsAbove
{
public:
  enum Side : char
  {
    below,
    above,
    between
  };

  MotionsAbove(const QuadraticMesh &mesh, const MultipointConstraints &constraints, const std::vector<int> &supported,
               const Plane &plane, const std::vector<double> &height, const Eigen::Matrix3d &axes,
               const Vector3d &about)
      : mesh_(mesh), constraints_(constraints), about_(about), side_(3 * std::size_t(mesh.n_nodes()), above)
  {
    axes_ << axes, Eigen::Matrix3d::Zero(), Eigen::Matrix3d::Zero(), axes;
    for (int cell = 0; cell < mesh.n_cells(); ++cell)
      if (height[cell] <= 0.)
        for (int a = 0; a < mesh.n_nodes_of(cell); ++a)
          std::fill_n(side_.begin() + 3 * mesh.nodes(cell)[a], 3, below);
    for (const int i : loaded(constraints))
      side_[i] = plane.height(vector_of(mesh.points[i / 3])) > 0. ? above : below;
    for (const int node : supported)
      std::fill_n(side_.begin() + 3 * node, 3, plane.height(vector_of(mesh.points[node])) > 0. ? above : below);
    std::vector<int> tied(constraints.ties.size(), -1); // in the order in which they depend on each other
    for (std::size_t i = 0; i < side_.size(); ++i)
      if (tie_of(int(i)))
        tied[constraints.tie_of[i]] = int(i);
    for (const int i : tied)
      if (i >= 0)
        side_[i] = side_of(*tie_of(i));
  }

  Side side(int displacement) const { return Side(side_[displacement]); }

  Motions w(const Point3 &x) const { return rigid_motions_of_point(x, about_) * axes_; }

  Motions v(int node) const
  {
    Motions result = w(mesh_.points[node]);
    for (int d = 0; d < 3; ++d)
      if (side(3 * node + d) == below)
        result.row(d).setZero();
      else if (side(3 * node + d) == between)
      {
        result.row(d).setZero();
        for (const auto &[i, weight] : *tie_of(3 * node + d))
          result.row(d) += weight * v(i / 3).row(i % 3);
      }
    return result;
  }

private:
  /// Displacements on which supports and interfaces act.
  std::vector<int> loaded(const MultipointConstraints &constraints) const
  {
    std::vector<int> all;
    const auto       add = [&](const Combination &of)
    {
      for (const auto &term : of)
        if (term.first < constraints.first_new())
          all.push_back(term.first);
    };
    for (int i = 0; i < constraints.first_new(); ++i)
      if (const int tie = constraints.tie_of[i]; constraints.held[i] || (tie >= 0 && !tie_of(i)))
      {
        all.push_back(i);
        add(tie >= 0 ? constraints.ties[tie] : Combination{});
      }
    for (const Combination &measure : constraints.measures)
      add(measure);
    return all;
  }

  /// Of a displacement tied to other displacements; null for others, also those tied to the node of an interface.
  const Combination *tie_of(int displacement) const
  {
    const int tie = constraints_.tie_of[displacement];
    if (tie < 0)
      return nullptr;
    const Combination &of = constraints_.ties[tie];
    return std::all_of(of.begin(), of.end(), [&](const auto &term) { return term.first < constraints_.first_new(); })
               ? &of
               : nullptr;
  }

  char side_of(const Combination &tie) const
  {
    const auto is = [&](char which)
    {
      return std::all_of(tie.begin(), tie.end(),
                         [&](const auto &term) { return term.second == 0. || side_[term.first] == which; });
    };
    return is(above) ? above : is(below) ? below : between;
  }

  const QuadraticMesh         &mesh_;
  const MultipointConstraints &constraints_;
  Vector3d                     about_;
  Eigen::Matrix<double, 6, 6>  axes_;
  std::vector<char>            side_; // [displacements]
};

[[noreturn]] void refuse(const CutSpecification &cut, const Plane &plane, const QuadraticMesh &mesh)
{
  std::vector<double> height;
  for (const auto &point : mesh.points)
    height.push_back(plane.height(vector_of(point)));
  const auto [low, high] = std::minmax_element(height.begin(), height.end());
  std::ostringstream message;
  message << head(cut) << ": the plane does not cut the frame, which extends from " << *low << " m to " << *high
          << " m along the normal, measured from the point (" << cut.through[0] << ", " << cut.through[1] << ", "
          << cut.through[2] << ") m; move the point into the frame.";
  throw std::invalid_argument(message.str());
}

using Rows = Eigen::Matrix<double, Eigen::Dynamic, 6>; // [3 nodes of a cell x 6]

/// int rho w N_a dV above the plane less sum_b M_ab v_b: the mass of a cell of which weight and inertia are not among
/// the loads of the rows.
Rows mass_between(const Plane &plane, const MotionsAbove &motions, const QuadraticMesh &mesh, int cell,
                  const Eigen::MatrixXd &M)
{
  const int  n     = mesh.n_nodes_of(cell);
  const auto point = [&](int a) { return vector_of(mesh.points[mesh.nodes(cell)[a]]); };
  Slice      slice;
  for (int a = 0; a < n; ++a)
    slice.origin += point(a) / n;
  add(slice, plane, mesh, cell);
  const bool      whole = slice.above >= slice.volume, part = slice.above > 0. && !whole;
  Rows            moved(3 * n, 6), rows                     = Rows::Zero(3 * n, 6);
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (int a = 0; a < n; ++a)
  {
    const int node             = mesh.nodes(cell)[a];
    moved.middleRows<3>(3 * a) = -motions.v(node);
    if (whole)
      moved.middleRows<3>(3 * a) += motions.w(mesh.points[node]);
    spread += (point(a) - slice.origin) * (point(a) - slice.origin).transpose();
  }
  const Vector3d        first   = slice.moment - slice.above * slice.origin;
  const Eigen::Matrix3d inverse = spread.inverse();
  const auto            w       = [&](const Vector3d &x) { return motions.w({x[0], x[1], x[2]}); };
  for (int a = 0; a < n; ++a)
  {
    for (int b = 0; b < n; ++b)
      rows.middleRows<3>(3 * a) += M(a, b) * moved.middleRows<3>(3 * b);
    if (!part)
      continue;
    // int w phi dV, phi = 1/n + slope . (x - x_o) the share of the node in a linear field
    const Vector3d slope = inverse * (point(a) - slice.origin);
    const Motions  at    = w(slice.origin);
    rows.middleRows<3>(3 * a) +=
        M.sum() / slice.volume *
        ((slice.above / n + slope.dot(first)) * at + w(slice.origin + first / n + slice.second * slope) - at);
  }
  return rows;
}

} // namespace

std::vector<FrameOutput> cut_forces(const CutSpecification &cut, const QuadraticMesh &mesh,
                                    const CellMaterials &materials, const AffineConstraints &affine,
                                    const std::vector<int> &supported, const std::array<double, 2> &rayleigh)
{
  const Plane               plane  = plane_of(cut);
  const Eigen::Matrix3d     axes   = axes_of(cut, plane.normal);
  const std::vector<double> height = heights(plane, mesh);
  const MotionsAbove        motions(mesh, affine.constraints(), supported, plane, height, axes,
                             cut.about ? vector_of(*cut.about) : centroid(plane, mesh));

  bool                                divides = false;
  Motions                             weight  = Motions::Zero();
  std::vector<Eigen::Triplet<double>> entries, inert;
  CellValues                          values(mesh, CellPoints::rule);
  for (int cell = 0; cell < mesh.n_cells(); ++cell)
  {
    const int *nodes   = mesh.nodes(cell);
    const int  n       = mesh.n_nodes_of(cell);
    const bool upper   = height[cell] > 0.;
    const auto usual   = upper ? MotionsAbove::above : MotionsAbove::below;
    const auto differs = [&](int node)
    {
      return motions.side(3 * node) != usual || motions.side(3 * node + 1) != usual ||
             motions.side(3 * node + 2) != usual;
    };
    const bool deforms = std::any_of(nodes, nodes + n, differs);
    const bool crossed = std::any_of(
        nodes, nodes + n, [&](int node) { return (plane.height(vector_of(mesh.points[node])) > 0.) != upper; });
    if (!deforms && !crossed)
      continue;
    const auto add_to = [&](std::vector<Eigen::Triplet<double>> &all, const Rows &rows)
    {
      for (int i = 0; i < 3 * n; ++i)
        for (int k = 0; k < 6; ++k)
          all.emplace_back(3 * nodes[i / 3] + i % 3, k, rows(i, k));
    };
    const Rows between = mass_between(plane, motions, mesh, cell, mass_matrix(values.of(cell), materials[cell].rho));
    add_to(inert, -between);
    for (int a = 0; a < n; ++a)
      weight += between.middleRows<3>(3 * a);
    if (!deforms)
      continue;
    divides = true;
    Rows v(3 * n, 6); // of an upper cell less w, without stress
    for (int a = 0; a < n; ++a)
      v.middleRows<3>(3 * a) = motions.v(nodes[a]) - double(upper) * motions.w(mesh.points[nodes[a]]);
    add_to(entries, tangent_stiffness(values.of(cell), mesh, materials, cell) * v);
  }
  if (!divides)
    refuse(cut, plane, mesh);
  const auto gathered = [&](const std::vector<Eigen::Triplet<double>> &of, int k)
  {
    Eigen::VectorXd row = Eigen::VectorXd::Zero(affine.n_displacements());
    for (const auto &entry : of)
      if (entry.col() == k)
        row[entry.row()] += entry.value();
    return affine.gather(row);
  };
  std::vector<FrameOutput> outputs;
  for (int k = 0; k < 6; ++k)
  {
    const Eigen::VectorXd on_q = gathered(entries, k), on_a = gathered(inert, k);
    const auto &[ending, unit] = section_components[k];
    outputs.push_back(
        {"cut." + cut.name + ending, unit, on_q, rayleigh[1] * on_q + rayleigh[0] * on_a, weight.col(k), on_a});
  }
  return outputs;
}

} // namespace gestell::fem
