#include "apps/study/optimum/pareto.h"

#include "apps/study/designs/response_designs.h"
#include "apps/study/designs/space_filling.h"
#include "apps/study/optimum/scaled_task.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gestell::apps
{
namespace
{

/// Goals as values to minimise, [rows x goals].
Eigen::MatrixXd to_minimise(Eigen::MatrixXd values, const std::vector<Sense> &senses)
{
  for (Eigen::Index j = 0; j < values.cols(); ++j)
    if (senses[j] == Sense::maximise)
      values.col(j) *= -1.;
  return values;
}

bool dominates(const Eigen::MatrixXd &values, int a, int b)
{
  return (values.row(a).array() <= values.row(b).array()).all();
}

std::vector<int> rows_by_goals(const Eigen::MatrixXd &values)
{
  std::vector<int> rows;
  for (int row = 0; row < values.rows(); ++row)
    if (values.row(row).allFinite())
      rows.push_back(row);
  std::stable_sort(rows.begin(), rows.end(),
                   [&](int a, int b)
                   {
                     for (Eigen::Index j = 0; j < values.cols(); ++j)
                       if (values(a, j) != values(b, j))
                         return values(a, j) < values(b, j);
                     return false;
                   });
  return rows;
}

/// Weights of m goals that sum to 1, in steps of 1 / (n - 1).
void add_weights(int goal, int left, int n, Eigen::VectorXd &weights, std::vector<Eigen::VectorXd> &all)
{
  if (goal + 1 == weights.size())
  {
    weights(goal)                 = left;
    constexpr double least_weight = 1e-3; // of a goal, so that the front's ends are not weakly dominated
    all.push_back((weights / (n - 1)).cwiseMax(least_weight));
    return;
  }
  for (int part = left; part >= 0; --part)
  {
    weights(goal) = part;
    add_weights(goal + 1, left - part, n, weights, all);
  }
}

/// Steps of the weights, so that about `points` of them come of it.
int weight_steps(int n_goals, int points)
{
  int    n     = 2;
  double count = n_goals;
  while (count < points)
  {
    ++n;
    count = count * (n + n_goals - 2) / (n - 1); // of (n + m - 2 over m - 1)
  }
  return n;
}

std::vector<Eigen::VectorXd> all_weights(int n_goals, int points)
{
  std::vector<Eigen::VectorXd> all;
  Eigen::VectorXd              weights(n_goals);
  const int                    n = weight_steps(n_goals, points);
  add_weights(0, n - 1, n, weights, all);
  return all;
}

/// Samples that keep the limits, with their outputs.
struct Samples
{
  std::vector<ParetoPoint> points;
  Eigen::MatrixXd          goals; ///< [points x goals], to minimise
};

std::vector<Sense> senses_of(const OptimumTask &task)
{
  std::vector<Sense> senses;
  for (const Goal &goal : task.goals)
    senses.push_back(goal.sense);
  return senses;
}

Eigen::MatrixXd goals_of(const std::vector<ParetoPoint> &points, const OptimumTask &task)
{
  Eigen::MatrixXd values(static_cast<Eigen::Index>(points.size()), static_cast<Eigen::Index>(task.goals.size()));
  for (Eigen::Index row = 0; row < values.rows(); ++row)
    for (Eigen::Index j = 0; j < values.cols(); ++j)
      values(row, j) = points[row].values(task.goals[j].output);
  return to_minimise(values, senses_of(task));
}

void add_samples(const OutputModel &model, const OptimumTask &task, const Eigen::MatrixXd &unit_points,
                 std::vector<ParetoPoint> &points)
{
  const Eigen::VectorXd middle = 0.5 * (task.low + task.high), half = 0.5 * (task.high - task.low);
  for (Eigen::Index row = 0; row < unit_points.rows(); ++row)
  {
    const Eigen::VectorXd xi     = middle + half.cwiseProduct(unit_points.row(row).transpose());
    const Eigen::VectorXd values = model(xi, Derivatives::none).values;
    if (violation_of(task.limits, values) <= kept_limits)
      points.push_back({xi, values});
  }
}

Samples samples_of(const OutputModel &model, const OptimumTask &task, const ParetoOptions &options)
{
  const int k = static_cast<int>(task.low.size());
  Samples   samples;
  add_samples(model, task, sobol_points(k, options.samples, options.seed).points, samples.points);
  constexpr int most_corners = 10; // variables: 1024 corners
  if (k <= most_corners)
    add_samples(model, task, full_factorial(std::vector<std::vector<double>>(k, {-1., 1.})).points, samples.points);
  samples.goals = goals_of(samples.points, task);
  return samples;
}

/// Best values of all goals on a front, and the ranges they take there.
struct FrontScale
{
  Eigen::VectorXd best, range;
};

FrontScale scale_of(const Eigen::MatrixXd &front)
{
  FrontScale scale;
  scale.best  = front.colwise().minCoeff().transpose();
  scale.range = front.colwise().maxCoeff().transpose() - scale.best;
  for (Eigen::Index j = 0; j < scale.range.size(); ++j)
    if (!(scale.range(j) > 0.))
      scale.range(j) = std::max(1e-12, std::abs(scale.best(j)));
  return scale;
}

/// Whether two rows differ by what searches leave.
bool is_same(const Eigen::MatrixXd &goals, int a, int b, const Eigen::VectorXd &range)
{
  constexpr double same_goals = 1e-5; // of the ranges of the goals on the front
  return (goals.row(a) - goals.row(b)).transpose().cwiseQuotient(range).cwiseAbs().maxCoeff() < same_goals;
}

std::vector<Sense> all_minimised(const OptimumTask &task)
{
  return std::vector<Sense>(task.goals.size(), Sense::minimise);
}

Eigen::MatrixXd front_of(const Samples &samples)
{
  const std::vector<Sense> minimise(static_cast<std::size_t>(samples.goals.cols()), Sense::minimise);
  return samples.goals(nondominated(samples.goals, minimise), Eigen::all);
}

/// The best points of each goal alone, the others counting little, as samples: samples seldom lie at the front's ends.
void add_ends(const OutputModel &model, const OptimumTask &task, Samples &samples)
{
  const FrontScale scale = scale_of(front_of(samples));
  for (std::size_t alone = 0; alone < task.goals.size(); ++alone)
  {
    OptimumTask end = task;
    for (std::size_t i = 0; i < task.goals.size(); ++i)
    {
      // enough to choose among equally good points, too little to move the best one visibly
      constexpr double weight_of_others = 1e-4;
      end.goals[i].weight               = i == alone ? 1. : weight_of_others;
      end.goals[i].scale                = scale.range(static_cast<Eigen::Index>(i));
    }
    if (const Optimum optimum = find_optimum(model, end); optimum.feasible)
      samples.points.push_back({optimum.coded, optimum.values});
  }
  samples.goals = goals_of(samples.points, task);
}

/// The largest of w_i (f_i - f_i*) / range_i as a problem with a slack variable t, the last: t with all of them below
/// t.
class Chebyshev
{
public:
  Chebyshev(const OutputModel &model, const OptimumTask &task, const FrontScale &scale, const Eigen::VectorXd &weights)
      : model_(model), task_(task), scale_(scale), weights_(weights), k_(task.low.size()), m_(weights.size())
  {
  }

  double largest(const Eigen::VectorXd &goals) const
  {
    return (goals - scale_.best).cwiseQuotient(scale_.range).cwiseProduct(weights_).maxCoeff();
  }

  OutputPoint functions(const Eigen::VectorXd &x) const
  {
    const OutputPoint outputs = model_(x.head(k_), Derivatives::wanted);
    const OutputPoint limits  = ScaledTask(task_, outputs, SearchMethod::derivative_free).functions(outputs);
    OutputPoint       F;
    F.values.setZero(1 + m_ + limits.values.size() - 1);
    F.derivatives.setZero(F.values.size(), k_ + 1);
    F.values(0)          = x(k_);
    F.derivatives(0, k_) = 1.;
    for (Eigen::Index i = 0; i < m_; ++i)
      add_goal(i, x(k_), outputs, F);
    F.values.tail(limits.values.size() - 1) = limits.values.tail(limits.values.size() - 1);
    F.derivatives.bottomLeftCorner(limits.values.size() - 1, k_) =
        limits.derivatives.bottomRows(limits.values.size() - 1);
    return F;
  }

private:
  void add_goal(Eigen::Index i, double t, const OutputPoint &outputs, OutputPoint &F) const
  {
    const Goal  &goal = task_.goals[i];
    const double sign = goal.sense == Sense::maximise ? -1. : 1., factor = weights_(i) / scale_.range(i);
    F.values(1 + i)                   = factor * (sign * outputs.values(goal.output) - scale_.best(i)) - t;
    F.derivatives.row(1 + i).head(k_) = factor * sign * outputs.derivatives.row(goal.output);
    F.derivatives(1 + i, k_)          = -1.;
  }

  const OutputModel     &model_;
  const OptimumTask     &task_;
  const FrontScale      &scale_;
  const Eigen::VectorXd &weights_;
  Eigen::Index           k_, m_;
};

ParetoPoint searched_point(const OutputModel &model, const OptimumTask &task, const Samples &samples,
                           const FrontScale &scale, const Eigen::VectorXd &weights)
{
  const Chebyshev chebyshev(model, task, scale, weights);
  Eigen::Index    start = 0;
  double          least = std::numeric_limits<double>::infinity();
  for (Eigen::Index row = 0; row < samples.goals.rows(); ++row)
    if (const double largest = chebyshev.largest(samples.goals.row(row).transpose()); largest < least)
    {
      least = largest;
      start = row;
    }

  const Eigen::Index k = task.low.size();
  Eigen::VectorXd    x(k + 1), low(k + 1), high(k + 1);
  x << samples.points[start].coded, least;
  low << task.low, least - 2.;
  high << task.high, least + 2.;
  const auto            functions     = [&](const Eigen::VectorXd &at, Derivatives) { return chebyshev.functions(at); };
  const int             n_constraints = static_cast<int>(chebyshev.functions(x).values.size()) - 1;
  const Eigen::VectorXd end =
      local_search(functions, n_constraints, x, {SearchMethod::gradient, low, high, 1e-9, 300}).x;

  ParetoPoint point{end.head(k), model(end.head(k), Derivatives::none).values};
  const bool  is_good = violation_of(task.limits, point.values) <= kept_limits &&
                       chebyshev.largest(goals_of({point}, task).row(0).transpose()) <= least;
  return is_good ? point : samples.points[start];
}

} // namespace

std::vector<int> nondominated(const Eigen::MatrixXd &values, const std::vector<Sense> &senses)
{
  const Eigen::MatrixXd small = to_minimise(values, senses);
  std::vector<int>      front;
  for (const int row : rows_by_goals(small)) // whoever dominates a row stands before it
    if (std::none_of(front.begin(), front.end(), [&](int other) { return dominates(small, other, row); }))
      front.push_back(row);
  return front;
}

std::vector<ParetoPoint> pareto_front(const OutputModel &model, const OptimumTask &task, const ParetoOptions &options)
{
  if (task.goals.size() < 2)
    throw std::invalid_argument("study: a Pareto front needs at least two goals; to minimise one use find_optimum");
  const Eigen::VectorXd middle = 0.5 * (task.low + task.high);
  const Eigen::VectorXd values = model(middle, Derivatives::none).values;
  check_task(task, static_cast<int>(values.size()));
  const OptimumTask sized   = sized_task(task, values);
  Samples           samples = samples_of(model, sized, options);
  if (samples.points.empty())
    return {};

  add_ends(model, sized, samples);
  const FrontScale         scale = scale_of(front_of(samples));
  std::vector<ParetoPoint> found;
  for (const Eigen::VectorXd &weights : all_weights(static_cast<int>(task.goals.size()), options.points))
    found.push_back(searched_point(model, sized, samples, scale, weights));

  const Eigen::MatrixXd    goals = goals_of(found, task);
  std::vector<ParetoPoint> front;
  std::vector<int>         kept;
  for (const int row : nondominated(goals, all_minimised(task)))
    if (std::none_of(kept.begin(), kept.end(), [&](int other) { return is_same(goals, other, row, scale.range); }))
    {
      kept.push_back(row);
      front.push_back(found[row]);
    }
  return front;
}

} // namespace gestell::apps
