#pragma once

#include <Eigen/Core>

#include <vector>

namespace gestell::coupling
{

/// Rows of g that belong to one joint, and the measures they depend on.
struct ConstraintBlock
{
  int    first_row, n_rows;
  int    first_measure, n_measures;
  double size; ///< of the numbers [m, rad] whose difference is g: its rounding error is this size times epsilon
};

inline int constraint_rows(const std::vector<ConstraintBlock> &blocks)
{
  return blocks.empty() ? 0 : blocks.back().first_row + blocks.back().n_rows;
}

/**
 * G = dg/du [n_c x n_u] of all joints: block diagonal, so that every product with it is linear in the number of joints.
 */
class ConstraintJacobian
{
public:
  using Block      = Eigen::Map<Eigen::MatrixXd>;
  using ConstBlock = Eigen::Map<const Eigen::MatrixXd>;

  explicit ConstraintJacobian(const std::vector<ConstraintBlock> &blocks = {});

  const std::vector<ConstraintBlock> &blocks() const { return blocks_; }
  int                                 n_rows() const { return constraint_rows(blocks_); }
  Block operator[](std::size_t i) { return {values_.data() + first_[i], blocks_[i].n_rows, blocks_[i].n_measures}; }
  ConstBlock operator[](std::size_t i) const
  {
    return {values_.data() + first_[i], blocks_[i].n_rows, blocks_[i].n_measures};
  }

  /// All blocks, column by column, one after the other.
  const Eigen::VectorXd &values() const { return values_; }

  /// p = G^T lambda on the measures of joints; all others are unchanged.
  void set_forces(const Eigen::VectorXd &lambda, Eigen::VectorXd &p) const;
  /// g += factor G u
  void add_product(double factor, const Eigen::VectorXd &u, Eigen::VectorXd &g) const;
  /// S G^T [n x n_c]
  void times_transposed(const Eigen::MatrixXd &S, Eigen::MatrixXd &product) const;
  /// G X [n_c x columns]
  void times(const Eigen::MatrixXd &X, Eigen::MatrixXd &product) const;

private:
  std::vector<ConstraintBlock> blocks_;
  std::vector<Eigen::Index>    first_;
  Eigen::VectorXd              values_;
};

} // namespace gestell::coupling
