#include "fem/assembly/interfaces.h"

#include "fem/assembly/rigid_motions.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace gestell::fem
{

namespace
{

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Rows6   = Eigen::Matrix<double, 6, Eigen::Dynamic>;

/// Six displacements and the others of a group; columns as numbered in W.
struct Group
{
  std::vector<int> pivots, others;
  Matrix6          W_p;       ///< columns of the pivots
  Rows6            of_others; ///< W_p^-1 W_o:  m = u_p + of_others u_o
};

/// W [6 x 3 nodes]: rigid motion of the surface at its centroid; column 3 i + d belongs to node i of the patch.
Rows6 averaging(const CoupledPatch &coupled, const QuadraticMesh &mesh)
{
  const std::vector<int> &nodes = coupled.patch.nodes;
  const int               n     = static_cast<int>(nodes.size());
  Eigen::MatrixXd         R(3 * n, 6), S_R(3 * n, 6);
  for (int i = 0; i < n; ++i)
    R.middleRows<3>(3 * i) = rigid_motions_of_point(mesh.points[nodes[i]], coupled.patch.centroid);
  for (int d = 0; d < 3; ++d)
    S_R(Eigen::seqN(d, n, 3), Eigen::all) = coupled.patch.S * Eigen::MatrixXd(R(Eigen::seqN(d, n, 3), Eigen::all));
  // About the centroid translations and rotations are uncoupled, so their different units do no harm to R^T S R.
  return Matrix6(R.transpose() * S_R).ldlt().solve(Eigen::MatrixXd(S_R.transpose()));
}

/// Motion of the centroid as a function of the motion of the node: [ I  -(x_c - x0)x ; 0  I ].
Matrix6 node_to_centroid(const CoupledPatch &coupled)
{
  const Eigen::Vector3d &centroid = coupled.patch.centroid;
  Matrix6                shift    = Matrix6::Identity();
  shift.topRows<3>() = rigid_motions_of_point(Point3{centroid[0], centroid[1], centroid[2]}, coupled.position);
  return shift;
}

/// Halves the range at the middle of its longest side until the groups are small.
void bisect(const CoupledPatch &coupled, const QuadraticMesh &mesh, std::vector<int> nodes,
            std::vector<std::vector<int>> &groups)
{
  // Nodes of a group: some hundred displacements, whose dense block is of the size of a front of the factorisation.
  constexpr std::size_t group_size = 64;
  if (nodes.size() <= group_size)
  {
    groups.push_back(std::move(nodes));
    return;
  }
  const auto at      = [&](int i, int d) { return mesh.points[coupled.patch.nodes[i]][d]; };
  int        longest = 0;
  double     extent  = -1.;
  for (int d = 0; d < 3; ++d)
  {
    const auto [low, high] =
        std::minmax_element(nodes.begin(), nodes.end(), [&](int i, int j) { return at(i, d) < at(j, d); });
    if (at(*high, d) - at(*low, d) > extent)
    {
      extent  = at(*high, d) - at(*low, d);
      longest = d;
    }
  }
  std::stable_sort(nodes.begin(), nodes.end(), [&](int i, int j) { return at(i, longest) < at(j, longest); });
  const auto middle = nodes.begin() + nodes.size() / 2;
  bisect(coupled, mesh, std::vector<int>(nodes.begin(), middle), groups);
  bisect(coupled, mesh, std::vector<int>(middle, nodes.end()), groups);
}

/// Order of columns by QR with column pivoting, with rotations scaled by `length`: the first six are well conditioned.
std::vector<int> pivot_order(const Rows6 &W, double length)
{
  Rows6 scaled = W;
  scaled.bottomRows<3>() *= length;
  const Eigen::ColPivHouseholderQR<Rows6> qr(scaled);
  const auto                             &order = qr.colsPermutation().indices();
  return {order.data(), order.data() + order.size()};
}

/// The middle nodes of the central triangle of a group; its three nodes share their neighbours in the mesh, so that the
/// dense rows of the six pivots cause the least fill in C. Empty if no triangle lies in the group.
std::vector<int> central_triangle(const CoupledPatch &coupled, const QuadraticMesh &mesh, const std::vector<int> &nodes)
{
  const std::vector<int> &all   = coupled.patch.nodes;
  const auto              point = [&](int node) { return Eigen::Map<const Eigen::Vector3d>(mesh.points[node].data()); };
  Eigen::Vector3d         centre = Eigen::Vector3d::Zero();
  std::vector<char>       inside(all.size(), 0);
  for (const int i : nodes)
  {
    centre += point(all[i]) / static_cast<double>(nodes.size());
    inside[i] = 1;
  }
  std::vector<int> best;
  double           least = std::numeric_limits<double>::max();
  for (const auto &face : coupled.patch.faces)
  {
    std::vector<int> middles;
    for (int k = 3; k < 6; ++k)
      middles.push_back(static_cast<int>(std::lower_bound(all.begin(), all.end(), face[k]) - all.begin()));
    const double distance = (point(face[3]) + point(face[4]) + point(face[5]) - 3. * centre).norm();
    if (distance < least && std::all_of(middles.begin(), middles.end(), [&](int i) { return inside[i]; }))
    {
      least = distance;
      best  = middles;
    }
  }
  return best;
}

std::vector<int> columns_of(const std::vector<int> &nodes)
{
  std::vector<int> columns;
  for (const int i : nodes)
    columns.insert(columns.end(), {3 * i, 3 * i + 1, 3 * i + 2});
  return columns;
}

Group make_group(const Rows6 &W, const std::vector<int> &nodes, const std::vector<int> &candidates, double length)
{
  const std::vector<int> choice = columns_of(candidates);
  Group                  group;
  for (const int k : pivot_order(W(Eigen::all, choice), length))
    if (group.pivots.size() < 6)
      group.pivots.push_back(choice[k]);
  for (const int column : columns_of(nodes))
    if (std::find(group.pivots.begin(), group.pivots.end(), column) == group.pivots.end())
      group.others.push_back(column);
  group.W_p       = W(Eigen::all, group.pivots);
  group.of_others = group.W_p.partialPivLu().solve(Rows6(W(Eigen::all, group.others)));
  return group;
}

std::vector<Group> make_groups(const CoupledPatch &coupled, const QuadraticMesh &mesh, const Rows6 &W)
{
  const double     length = std::sqrt(coupled.patch.area);
  std::vector<int> all(coupled.patch.nodes.size());
  std::iota(all.begin(), all.end(), 0);
  std::vector<std::vector<int>> node_groups;
  bisect(coupled, mesh, all, node_groups);

  std::vector<Group> groups;
  if (node_groups.size() > 1)
    for (const std::vector<int> &nodes : node_groups)
    {
      const std::vector<int> triangle = central_triangle(coupled, mesh, nodes);
      groups.push_back(make_group(W, nodes, triangle.empty() ? nodes : triangle, length));
      // Lengths count in units of the surface, so factors above this show a degenerate group: then the surface is one
      // group.
      constexpr double largest_factor = 1e4;
      if (!(groups.back().of_others.cwiseAbs().maxCoeff() < largest_factor))
        return {make_group(W, all, all, length)};
    }
  else
    groups.push_back(make_group(W, all, all, length));
  return groups;
}

/// The inner coordinates m of all groups as combinations of values; six are eliminated: m_e = W_e^-1 (p - W_r m_r).
std::vector<Combination> inner_coordinates(const std::vector<Group> &groups, const CoupledPatch &coupled, int first,
                                           int first_inner)
{
  Rows6 W(6, 6 * groups.size());
  for (std::size_t g = 0; g < groups.size(); ++g)
    W.middleCols<6>(6 * g) = groups[g].W_p;
  const std::vector<int> order = pivot_order(W, std::sqrt(coupled.patch.area));

  const std::vector<int> eliminated(order.begin(), order.begin() + 6), rest(order.begin() + 6, order.end());
  const Matrix6          inverse = Matrix6(W(Eigen::all, eliminated)).inverse();
  const Matrix6          of_node = inverse * node_to_centroid(coupled);
  const Rows6            of_rest = inverse * W(Eigen::all, rest);

  std::vector<Combination> m(W.cols());
  for (std::size_t k = 0; k < rest.size(); ++k)
    m[rest[k]] = {{first_inner + static_cast<int>(k), 1.}};
  for (int e = 0; e < 6; ++e)
  {
    for (int j = 0; j < 6; ++j)
      m[eliminated[e]].emplace_back(first + j, of_node(e, j));
    for (std::size_t k = 0; k < rest.size(); ++k)
      m[eliminated[e]].emplace_back(first_inner + static_cast<int>(k), -of_rest(e, k));
  }
  return m;
}

} // namespace

void tie_average(const CoupledPatch &coupled, const QuadraticMesh &mesh, int first, MultipointConstraints &constraints)
{
  const Rows6              W            = averaging(coupled, mesh);
  const std::vector<Group> groups       = make_groups(coupled, mesh, W);
  const int                first_inner  = constraints.first_new() + static_cast<int>(constraints.measures.size());
  const auto               m            = inner_coordinates(groups, coupled, first, first_inner);
  const auto               displacement = [&](int column) { return 3 * coupled.patch.nodes[column / 3] + column % 3; };

  constraints.measures.resize(constraints.measures.size() + 6 * groups.size() - 6);
  for (std::size_t g = 0; g < groups.size(); ++g)
  {
    const Group &group = groups[g];
    for (int k = 0; k < 6; ++k)
    {
      Combination tie = m[6 * g + k], measure{{displacement(group.pivots[k]), 1.}};
      for (std::size_t j = 0; j < group.others.size(); ++j)
      {
        tie.emplace_back(displacement(group.others[j]), -group.of_others(k, j));
        measure.emplace_back(displacement(group.others[j]), group.of_others(k, j));
      }
      constraints.tie(displacement(group.pivots[k]), std::move(tie));
      if (m[6 * g + k].size() == 1)
        constraints.measures[m[6 * g + k].front().first - constraints.first_new()] = std::move(measure);
    }
  }
}

} // namespace gestell::fem
