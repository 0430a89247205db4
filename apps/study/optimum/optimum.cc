#include "apps/study/optimum/optimum.h"

#include "apps/study/designs/space_filling.h"
#include "apps/study/optimum/scaled_task.h"
#include "apps/study/optimum/side_by_side.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gestell::apps
{
namespace
{

[[noreturn]] void refuse_search(const std::string &text)
{
  throw std::invalid_argument("study: optimum: " + text);
}

bool is_better(const SearchTrack &a, const SearchTrack &b)
{
  if (a.feasible != b.feasible)
    return a.feasible;
  return a.feasible ? a.objective < b.objective : a.violation < b.violation;
}

bool is_stopped(const OptimumOptions &options)
{
  return options.stop && *options.stop;
}

Derivatives derivatives_for(SearchMethod method)
{
  return method == SearchMethod::gradient ? Derivatives::wanted : Derivatives::none;
}

void check_options(const OptimumOptions &options)
{
  if (options.starts < 1)
    refuse_search("it has " + std::to_string(options.starts) + " starts; at least one is needed");
  if (!(options.tolerance > 0.))
    refuse_search("its tolerance is " + short_text(options.tolerance) + "; it must be positive");
  if (options.most_evaluations < 1)
    refuse_search("it may make " + std::to_string(options.most_evaluations) + " evaluations; at least one is needed");
}

/// Where the searches begin, one per row.
Eigen::MatrixXd starts_in(const OptimumTask &task, const OptimumOptions &options)
{
  const auto            k      = task.low.size();
  const Eigen::VectorXd middle = 0.5 * (task.low + task.high), half = 0.5 * (task.high - task.low);
  Eigen::MatrixXd       starts = sobol_points(static_cast<int>(k), options.starts, options.seed).points;
  starts.row(0).setZero();
  return (starts * half.asDiagonal()).rowwise() + middle.transpose();
}

SearchTrack searched(RememberedModel &model, const OptimumTask &task, const Eigen::VectorXd &start,
                     const OptimumOptions &options)
{
  int        evaluations = 0;
  const auto outputs_at  = [&](const Eigen::VectorXd &xi, Derivatives derivatives)
  {
    bool        is_new = false;
    OutputPoint point  = model.at(xi, derivatives, &is_new);
    evaluations += is_new;
    return point;
  };
  const ScaledTask scaled(task, outputs_at(start, derivatives_for(options.method)), options.method);
  const auto       functions = [&](const Eigen::VectorXd &xi, Derivatives derivatives)
  { return scaled.functions(outputs_at(xi, derivatives)); };
  const SearchEnd end =
      local_search(functions, scaled.n_constraints(), start,
                   {options.method, task.low, task.high, options.tolerance, options.most_evaluations, options.stop});

  const Eigen::VectorXd values = outputs_at(end.x, Derivatives::none).values;
  SearchTrack           track{start, end.x, objective_of(task.goals, values), violation_of(task.limits, values)};
  track.feasible    = track.violation <= kept_limits && std::isfinite(track.objective);
  track.evaluations = evaluations;
  track.reason      = end.reason;
  return track;
}

} // namespace

Optimum find_optimum(const OutputModel &model, const OptimumTask &requested, const OptimumOptions &options)
{
  check_options(options);
  RememberedModel       remembered(model);
  const Eigen::MatrixXd starts = starts_in(requested, options);
  const Eigen::VectorXd first  = remembered.at(starts.row(0).transpose(), derivatives_for(options.method)).values;
  check_task(requested, static_cast<int>(first.size()));
  const OptimumTask task = sized_task(requested, first);

  std::vector<SearchTrack> searches(static_cast<std::size_t>(starts.rows()));
  side_by_side(options.starts, options.side_by_side,
               [&](int row)
               {
                 if (!is_stopped(options))
                   searches[static_cast<std::size_t>(row)] =
                       searched(remembered, task, starts.row(row).transpose(), options);
               });
  searches.erase(
      std::remove_if(searches.begin(), searches.end(), [](const SearchTrack &search) { return search.to.size() == 0; }),
      searches.end());
  if (searches.empty())
    refuse_search("it was stopped before its first search");
  const auto best = std::min_element(searches.begin(), searches.end(), is_better);
  return {best->to,
          remembered.at(best->to, Derivatives::none).values,
          best->objective,
          best->feasible,
          remembered.n_evaluations(),
          remembered.n_failed(),
          searches};
}

} // namespace gestell::apps
