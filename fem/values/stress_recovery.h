#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <array>
#include <string>
#include <vector>

namespace gestell::fem
{

/**
 * Stresses at the skin of a frame, linear in its coordinates q.
 *
 * With the displacements u = G q of the nodes near the skin, a gradient H_kl = du_k/dx_l at every stress point is a sum
 * over these nodes, and Hooke's law gives
 *
 *     sigma = lambda (H_xx + H_yy + H_zz) I + mu (H + H^T).
 *
 * A stress point is a point of the picture in one material: where two materials meet on the skin there is one for each,
 * because the stress jumps there.  Components have the order xx yy zz xy yz xz, tension positive.
 */
struct StressRecovery
{
  using Rows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

  std::vector<int>                   point;     ///< [points] of the picture
  std::vector<std::array<int, 3>>    triangles; ///< into stress points; same order as those of the picture
  std::vector<std::array<double, 2>> lame;      // [points] lambda, mu [Pa]
  Rows                               u;         // [3 nodes x n] G, displacement d of node i in row 3 i + d
  Rows                               mean;   // [points x 3 nodes] du/dx_l in columns 3 i + l: mean over all cells there
  Rows                               of_one; // the same in the cell with a triangle there

  /// Supports and interfaces that make surfaces rigid: at their edges the stress is singular under mesh refinement.
  std::vector<std::string> rigid;
  std::vector<int>         nearby; ///< [points] of `rigid`: has a part in a cell at the point; -1: none

  /// Of a frame of reduced parts in place of the operators above, by (q; g), g the acceleration field [6 points x (n +
  /// 3); Pa].
  Eigen::MatrixXf mean_by_state, deviation_by_state;

  bool empty() const { return point.empty(); }
};

/// Components of a stress.
constexpr int                                         stress_components = 6;
constexpr std::array<const char *, stress_components> stress_names{"xx", "yy", "zz", "xy", "yz", "xz"};

/// Choice of the gradient.
enum class StressOf
{
  mean,     ///< recovered: the mean over the cells of one material at the point, weighted by volume
  deviation ///< difference between one of these cells and the mean: disagreement of adjacent cells
};

/// Stresses [6 points x k; Pa] of states q [n x k].
Eigen::MatrixXd stresses(const StressRecovery &recovery, const Eigen::Ref<const Eigen::MatrixXd> &q, StressOf which);

/// Stresses [6 points x 3; Pa] of a unit acceleration field without motion of q, or empty: none.
Eigen::MatrixXd stresses_under_acceleration(const StressRecovery &recovery, StressOf which);

} // namespace gestell::fem
