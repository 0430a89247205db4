#include "apps/study/optimum/scaled_task.h"

#include <algorithm>
#include <cmath>

namespace gestell::apps
{
namespace
{

double positive_or_one(double x)
{
  return std::isfinite(x) && x > 0. ? x : 1.;
}

/// Sizes of limits that were not given: the larger of the limit and the output at the start.
void fill_sizes(std::vector<Limit> &limits, const Eigen::VectorXd &values)
{
  for (Limit &limit : limits)
    if (limit.size <= 0.)
    {
      double size = std::isfinite(values(limit.output)) ? std::abs(values(limit.output)) : 0.;
      for (const double bound : {limit.least, limit.most})
        if (std::isfinite(bound))
          size = std::max(size, std::abs(bound));
      limit.size = positive_or_one(size);
    }
}

int count_constraints(const std::vector<Limit> &limits)
{
  int n = 0;
  for (const Limit &limit : limits)
    n += std::isfinite(limit.least) + std::isfinite(limit.most);
  return n;
}

} // namespace

OptimumTask sized_task(OptimumTask task, const Eigen::VectorXd &values)
{
  fill_sizes(task.limits, values);
  return task;
}

ScaledTask::ScaledTask(const OptimumTask &task, const OutputPoint &start, SearchMethod method)
    : task_(sized_task(task, start.values)), n_constraints_(count_constraints(task.limits))
{
  const double objective = objective_of(task.goals, start.values);
  offset_                = std::isfinite(objective) ? objective : 0.;
  sigma_                 = positive_or_one(std::abs(objective));
  if (method == SearchMethod::gradient && start.derivatives.size() > 0)
  {
    const Eigen::VectorXd half_width = 0.5 * (task.high - task.low);
    const Eigen::VectorXd slope      = objective_gradient(task.goals, start.derivatives);
    // In half widths of the box, of the steepest variable: flatter ones reach its walls, too.
    constexpr double first_step = 100.;
    sigma_                      = positive_or_one(slope.cwiseQuotient(half_width).cwiseAbs().maxCoeff() / first_step);
  }
}

OutputPoint ScaledTask::functions(const OutputPoint &outputs) const
{
  const bool  has_derivatives = outputs.derivatives.size() > 0;
  OutputPoint F;
  F.values.resize(1 + n_constraints_);
  F.values(0) = (objective_of(task_.goals, outputs.values) - offset_) / sigma_;
  if (has_derivatives)
  {
    F.derivatives.resize(F.values.size(), outputs.derivatives.cols());
    F.derivatives.row(0) = objective_gradient(task_.goals, outputs.derivatives).transpose() / sigma_;
  }

  Eigen::Index row        = 1;
  const auto   add_excess = [&](const Limit &limit, double sign, double bound)
  {
    if (!std::isfinite(bound))
      return;
    F.values(row) = sign * (outputs.values(limit.output) - bound) / limit.size;
    if (has_derivatives)
      F.derivatives.row(row) = sign * outputs.derivatives.row(limit.output) / limit.size;
    ++row;
  };
  for (const Limit &limit : task_.limits)
  {
    add_excess(limit, 1., limit.most);
    add_excess(limit, -1., limit.least);
  }
  return F;
}

} // namespace gestell::apps
