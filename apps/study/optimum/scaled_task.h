#pragma once

#include "apps/study/optimum/local_search.h"
#include "apps/study/optimum/optimum_task.h"

namespace gestell::apps
{

/// The task with the sizes of its limits, where they are not given: the larger of limit and output.
OptimumTask sized_task(OptimumTask task, const Eigen::VectorXd &values);

/**
 * A task as local_search takes it:
 *
 *     F_0 = (objective - objective at the start) / sigma,        F_i = (value - most) / size,  (least - value) / size
 * <= 0.
 *
 * For searches by gradients sigma is so small that the first step, along -dF_0/dxi, ends at the walls of the box: there
 * optima often lie, and a step that was too long costs one point more while steps too short cost many.
 */
class ScaledTask
{
public:
  /// @param start  with derivatives if the method wants them
  ScaledTask(const OptimumTask &task, const OutputPoint &start, SearchMethod method);

  int         n_constraints() const { return n_constraints_; }
  OutputPoint functions(const OutputPoint &outputs) const;

private:
  OptimumTask task_;
  double      offset_ = 0., sigma_ = 1.;
  int         n_constraints_ = 0;
};

} // namespace gestell::apps
