#include "apps/study/optimum/optimum_task.h"

#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gestell::apps
{
namespace
{

[[noreturn]] void refuse_task(const std::string &text)
{
  throw std::invalid_argument("study: optimum: " + text);
}

void check_output(int output, int n_outputs)
{
  if (output < 0 || output >= n_outputs)
    refuse_task("output " + std::to_string(output + 1) + " of " + std::to_string(n_outputs) + " does not exist");
}

void check_goal(const Goal &goal, int n_outputs)
{
  check_output(goal.output, n_outputs);
  if (!(goal.weight > 0. && goal.scale > 0.) || !std::isfinite(goal.weight) || !std::isfinite(goal.scale))
    refuse_task("weight " + short_text(goal.weight) + " and scale " + short_text(goal.scale) +
                " of a goal must be positive; to reward large values use maximise");
}

void check_limit(const Limit &limit, int n_outputs)
{
  check_output(limit.output, n_outputs);
  if (!(limit.least <= limit.most))
    refuse_task("the limit from " + short_text(limit.least) + " to " + short_text(limit.most) + " is empty");
}

double signed_weight(const Goal &goal)
{
  return (goal.sense == Sense::minimise ? goal.weight : -goal.weight) / goal.scale;
}

} // namespace

double Limit::size_at(double bound) const
{
  return size > 0. ? size : bound != 0. ? std::abs(bound) : 1.;
}

double objective_of(const std::vector<Goal> &goals, const Eigen::VectorXd &values)
{
  double sum = 0.;
  for (const Goal &goal : goals)
    sum += signed_weight(goal) * values(goal.output);
  return sum;
}

Eigen::VectorXd objective_gradient(const std::vector<Goal> &goals, const Eigen::MatrixXd &derivatives)
{
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(derivatives.cols());
  for (const Goal &goal : goals)
    sum += signed_weight(goal) * derivatives.row(goal.output).transpose();
  return sum;
}

double violation_of(const std::vector<Limit> &limits, const Eigen::VectorXd &values)
{
  double worst = 0.;
  for (const Limit &limit : limits)
  {
    const double value = values(limit.output);
    if (!std::isfinite(value))
      return std::numeric_limits<double>::infinity();
    worst = std::max(
        {worst, (value - limit.most) / limit.size_at(limit.most), (limit.least - value) / limit.size_at(limit.least)});
  }
  return worst;
}

void check_task(const OptimumTask &task, int n_outputs)
{
  if (task.goals.empty())
    refuse_task("it has no goals; name an output to minimise or maximise");
  for (const Goal &goal : task.goals)
    check_goal(goal, n_outputs);
  for (const Limit &limit : task.limits)
    check_limit(limit, n_outputs);
  if (task.low.size() == 0 || task.low.size() != task.high.size() || !(task.low.array() < task.high.array()).all())
    refuse_task("the range of its variables is empty");
}

} // namespace gestell::apps
