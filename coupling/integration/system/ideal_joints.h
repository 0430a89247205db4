#pragma once

#include "coupling/integration/system/constraint_jacobian.h"
#include "coupling/integration/system/local_forces.h"

#include <string>
#include <vector>

namespace gestell::coupling
{

/// g(t, u) = 0 of the ideal joints, G = dg/du [n_c x n_u] with a constant pattern, a few rows per joint; their forces
/// are p = G^T lambda.  By default there are none.
class IdealJoints
{
public:
  virtual ~IdealJoints() = default;

  int n_rows() const { return constraint_rows(blocks()); } ///< n_c
  /// Rows of g and measures of each joint; force elements and their derivatives do not use these measures.
  virtual const std::vector<ConstraintBlock> &blocks() const;
  /// g [n_c] and G at state.t, state.u.
  virtual void constraints(const LocalState &state, Eigen::VectorXd &g, ConstraintJacobian &G) const;
  /// The terms rate in g' = G u' + rate and bias in g'' = G u'' + bias, [n_c] each.
  virtual void rates(const LocalState &state, Eigen::VectorXd &rate, Eigen::VectorXd &bias) const;
  /// Whether the multipliers are needed: those of index 3 contain rounding errors amplified by 1/h^2, and are then
  /// computed from g'' = 0.
  virtual bool wants_multipliers() const { return false; }
  /// Joint and direction of row i, for messages: "crank pin, along x".
  virtual std::string name(int i) const;
  /// Of block b: whether its equation r depends on its measure k; false: that entry of G is always zero.
  virtual bool depends(std::size_t b, int r, int k) const { return (void)b, (void)r, (void)k, true; }
};

} // namespace gestell::coupling
