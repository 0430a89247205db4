#pragma once

#include "coupling/integration/system/constraint_jacobian.h"
#include "coupling/integration/system/local_forces.h"

#include <string>
#include <vector>

namespace gestell::coupling
{

/// g(t, u) = 0 of the ideal joints, G = dg/du [n_c x n_u] constant in its pattern, a few rows per joint; their forces
/// are p = G^T lambda.  This one has none.
class IdealJoints
{
public:
  virtual ~IdealJoints() = default;

  int n_rows() const { return constraint_rows(blocks()); } ///< n_c
  /// Rows of g and measures of each joint; forces and their derivatives leave these measures alone.
  virtual const std::vector<ConstraintBlock> &blocks() const;
  /// g [n_c] and G at state.t, state.u.
  virtual void constraints(const LocalState &state, Eigen::VectorXd &g, ConstraintJacobian &G) const;
  /// What g' = G u' + rate and g'' = G u'' + bias have beyond the first terms, [n_c] each.
  virtual void rates(const LocalState &state, Eigen::VectorXd &rate, Eigen::VectorXd &bias) const;
  /// Somebody looks at the multipliers: those of index 3 carry rounding enlarged by 1/h^2, and are found from g'' = 0
  /// then.
  virtual bool wants_multipliers() const { return false; }
  /// Joint and direction of row i, for messages: "crank pin, along x".
  virtual std::string name(int i) const;
};

} // namespace gestell::coupling
