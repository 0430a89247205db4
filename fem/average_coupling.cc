#include "fem/interfaces.h"

#include "fem/rigid_motions.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>

#include <algorithm>
#include <numeric>

namespace gestell::fem
{

namespace
{

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Rows6   = Eigen::Matrix<double, 6, Eigen::Dynamic>;

// Nodes of a group: some hundred displacements, whose dense block is of the size of a front of the factorisation.
constexpr std::size_t group_size = 64;
// Pivots of a group below this share of the largest would amplify rounding: then the surface is one group.
constexpr double least_pivot = 1e-5;

/// Six displacements and the others of a group; columns as numbered in W.
struct Group
{
  std::vector<int> pivots, others;
  Matrix6          W_p;
};

/// W [6 x 3 nodes]: node motion from the surface's displacements, column 3 i + d for node i of the patch.
Rows6 averaging(const CoupledPatch &coupled, const QuadraticMesh &mesh)
{
  const std::vector<int> &nodes = coupled.patch.nodes;
  const int               n     = static_cast<int>(nodes.size());
  Eigen::MatrixXd         R(3 * n, 6), S_R(3 * n, 6);
  for (int i = 0; i < n; ++i)
    R.middleRows<3>(3 * i) = rigid_motions_of_point(mesh.points[nodes[i]], coupled.position);
  for (int d = 0; d < 3; ++d)
    S_R(Eigen::seqN(d, n, 3), Eigen::all) = coupled.patch.S * Eigen::MatrixXd(R(Eigen::seqN(d, n, 3), Eigen::all));
  // Lengths in units of the surface keep the six equations of one size.
  const double  length = std::sqrt(coupled.patch.area);
  Eigen::VectorXd unit(6);
  unit << 1., 1., 1., 1. / length, 1. / length, 1. / length;
  const Matrix6 gram = unit.asDiagonal() * Matrix6(R.transpose() * S_R) * unit.asDiagonal();
  return unit.asDiagonal() * gram.ldlt().solve(Eigen::MatrixXd(unit.asDiagonal() * S_R.transpose()));
}

/// Halves the range at the middle of its longest side until the groups are small.
void bisect(const CoupledPatch &coupled, const QuadraticMesh &mesh, std::vector<int> nodes,
            std::vector<std::vector<int>> &groups)
{
  if (nodes.size() <= group_size)
  {
    groups.push_back(std::move(nodes));
    return;
  }
  const auto at = [&](int i, int d) { return mesh.points[coupled.patch.nodes[i]][d]; };
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

struct Pivots
{
  std::vector<int> order; ///< columns, the six pivots first
  double           share; ///< of the least pivot in the largest
};

/// Six columns that make a well-conditioned block: QR with column pivoting, rotations measured in `length`.
Pivots choose_pivots(const Rows6 &W, double length)
{
  Rows6 scaled = W;
  scaled.bottomRows<3>() *= length;
  const Eigen::ColPivHouseholderQR<Rows6> qr(scaled);
  Pivots                                  result;
  const auto                             &order = qr.colsPermutation().indices();
  result.order.assign(order.data(), order.data() + order.size());
  const auto diagonal = qr.matrixQR().diagonal().cwiseAbs();
  result.share        = diagonal.size() < 6 ? 0. : diagonal.minCoeff() / diagonal.maxCoeff();
  return result;
}

std::vector<Group> make_groups(const Rows6 &W, const std::vector<std::vector<int>> &node_groups, double length,
                               double *share)
{
  std::vector<Group> groups;
  *share = 1.;
  for (const std::vector<int> &nodes : node_groups)
  {
    std::vector<int> columns;
    for (const int i : nodes)
      columns.insert(columns.end(), {3 * i, 3 * i + 1, 3 * i + 2});
    const Pivots pivots = choose_pivots(W(Eigen::all, columns), length);
    *share              = std::min(*share, pivots.share);
    Group group;
    for (std::size_t k = 0; k < columns.size(); ++k)
      (k < 6 ? group.pivots : group.others).push_back(columns[pivots.order[k]]);
    group.W_p = W(Eigen::all, group.pivots);
    groups.push_back(std::move(group));
  }
  return groups;
}

std::vector<Group> make_groups(const CoupledPatch &coupled, const QuadraticMesh &mesh, const Rows6 &W)
{
  std::vector<int> all(coupled.patch.nodes.size());
  std::iota(all.begin(), all.end(), 0);
  std::vector<std::vector<int>> node_groups;
  bisect(coupled, mesh, all, node_groups);

  const double       length = std::sqrt(coupled.patch.area);
  double             share  = 0.;
  std::vector<Group> groups = make_groups(W, node_groups, length, &share);
  return share > least_pivot ? groups : make_groups(W, {all}, length, &share);
}

/// The inner coordinates m of all groups in terms of values:  m_e = W_e^-1 (p - W_r m_r)  for the six eliminated ones.
std::vector<Combination> inner_coordinates(const std::vector<Group> &groups, double length, int first,
                                           int first_inner)
{
  Rows6 W(6, 6 * groups.size());
  for (std::size_t g = 0; g < groups.size(); ++g)
    W.middleCols<6>(6 * g) = groups[g].W_p;
  const std::vector<int> order = choose_pivots(W, length).order;

  const std::vector<int> eliminated(order.begin(), order.begin() + 6), rest(order.begin() + 6, order.end());
  const Matrix6          inverse = Matrix6(W(Eigen::all, eliminated)).inverse();
  const Rows6            of_rest = inverse * W(Eigen::all, rest);

  std::vector<Combination> m(W.cols());
  for (std::size_t k = 0; k < rest.size(); ++k)
    m[rest[k]] = {{first_inner + static_cast<int>(k), 1.}};
  for (int e = 0; e < 6; ++e)
  {
    for (int j = 0; j < 6; ++j)
      m[eliminated[e]].emplace_back(first + j, inverse(e, j));
    for (std::size_t k = 0; k < rest.size(); ++k)
      m[eliminated[e]].emplace_back(first_inner + static_cast<int>(k), -of_rest(e, k));
  }
  return m;
}

} // namespace

void tie_average(const CoupledPatch &coupled, const QuadraticMesh &mesh, int first, Constraints &constraints)
{
  const Rows6              W           = averaging(coupled, mesh);
  const std::vector<Group> groups      = make_groups(coupled, mesh, W);
  const int                first_inner = constraints.first_new() + static_cast<int>(constraints.measures.size());
  const auto               m = inner_coordinates(groups, std::sqrt(coupled.patch.area), first, first_inner);
  const auto displacement    = [&](int column) { return 3 * coupled.patch.nodes[column / 3] + column % 3; };

  constraints.measures.resize(constraints.measures.size() + 6 * groups.size() - 6);
  for (std::size_t g = 0; g < groups.size(); ++g)
  {
    // m_g = u_p + W_p^-1 W_o u_o
    const Group      &group = groups[g];
    const Rows6       of_others = group.W_p.partialPivLu().solve(Rows6(W(Eigen::all, group.others)));
    for (int k = 0; k < 6; ++k)
    {
      Combination tie = m[6 * g + k], measure{{displacement(group.pivots[k]), 1.}};
      for (std::size_t j = 0; j < group.others.size(); ++j)
      {
        tie.emplace_back(displacement(group.others[j]), -of_others(k, j));
        measure.emplace_back(displacement(group.others[j]), of_others(k, j));
      }
      constraints.tie(displacement(group.pivots[k]), std::move(tie));
      if (m[6 * g + k].size() == 1)
        constraints.measures[m[6 * g + k].front().first - constraints.first_new()] = std::move(measure);
    }
  }
}

} // namespace gestell::fem
