#pragma once

#include "coupling/integration/propagation/modal_blocks.h"

#include <Eigen/Core>

#include <vector>

namespace gestell::coupling
{

/**
 * The base system as seen by its measures: blocks of modes, the input of the elements' forces, and the output to the
 * measures.
 *
 * States are stored as all first states of the blocks, then all second ones, each padded to a multiple of four by zero
 * blocks: x [2 n_p].
 */
struct ModalMeasures
{
  std::vector<ModalBlock> blocks; ///< [n_p], with the padding
  int                     n_p     = 0;
  int                     n_modal = 0;
  Eigen::MatrixXd         read_u, read_v; ///< u = read_u^T x, u' = read_v^T x [2 n_p x n_u]
  Eigen::MatrixXd         put;            ///< x' = ... + put p [2 n_p x n_u]
  Eigen::VectorXd         constant;       ///< x' = ... + constant, of the constant load [2 n_p]

  ModalMeasures() = default;
  ModalMeasures(const ModalBlocks &modes, const SecondOrderSystem &system);
};

/// Matrix [2 n_b columns] in the order of ModalBlocks, with columns reordered as in ModalMeasures: [rows x 2 n_p].
Eigen::MatrixXd reordered(const Eigen::MatrixXd &by_blocks, int n_p);

/**
 * Forces over a step of length h as polynomials of sigma = (t - t_k)/h: p(sigma) = sum_j p_j l_j(sigma), and the points
 * at which the measures are evaluated.
 */
struct ForceBasis
{
  Eigen::MatrixXd     l;      ///< l_j(sigma) = sum_m l(j, m) sigma^m  [n_basis x degree + 1]
  std::vector<double> points; ///< in (0, 1], the last one 1

  static ForceBasis constant();
  static ForceBasis linear();
  static ForceBasis gauss(int s); ///< Lagrange polynomials at the s Gauss points, which are the points, and 1

  int    size() const { return static_cast<int>(l.rows()); }
  double value(int j, double sigma) const;
};

/**
 * Tables for one step length: from x(t_k) and the p_j follow exactly
 *
 *     x(t_k + h)   = E x + sum_j in_j p_j + c
 *     u(t_k + c_i h) = rows_i^T x + sum_j S_u(i, j) p_j + ...,      u' likewise.
 *
 * With the phi functions of the blocks:  in_j = h sum_m l(j, m) m! phi_m+1(Lambda h) put.
 */
struct StepTable
{
  double          h = 0.;
  Eigen::MatrixXd E;            ///< [n_p x 4]: e11, e12, e21, e22 by block
  Eigen::MatrixXd in;           ///< [2 n_p x n_basis n_u]
  Eigen::VectorXd constant;     ///< c [2 n_p]
  Eigen::MatrixXd rows;         ///< per point u then u' [2 n_p x n_points 2 n_u]
  Eigen::VectorXd row_constant; ///< [n_points 2 n_u]
  Eigen::MatrixXd S_u, S_v;     ///< [n_points n_u x n_basis n_u]

  /// Allocates only when called for the first time.
  void fill(const ModalMeasures &system, const ForceBasis &basis, double h);
  /// x_end = E x
  void carry(const Eigen::VectorXd &x, Eigen::VectorXd &x_end) const;

private:
  void fill_block(const ModalMeasures &system, const ForceBasis &basis, int point, int block);

  Eigen::MatrixXd weighted_; ///< [2 n_p x n_u]
};

/// x at the time tau after the start of a step of length h, from x at its start and the p_j [n_basis n_u].
void carry_inside(const ModalMeasures &system, const ForceBasis &basis, double tau, double h, const Eigen::VectorXd &p,
                  Eigen::VectorXd &x);

} // namespace gestell::coupling
