#pragma once

#include <Eigen/Core>

#include <limits>
#include <vector>

namespace gestell::apps
{

/// A limit may be broken by so much of its size: searches keep limits to some 1e-9 in their own scale.
constexpr double kept_limits = 1e-6;

enum class Sense
{
  minimise,
  maximise
};

/// An output that shall be small or large.
struct Goal
{
  int    output = 0; ///< its place among the model's outputs
  Sense  sense  = Sense::minimise;
  double weight = 1.; ///< > 0
  double scale  = 1.; ///< what the output is divided by, such as its reference value; > 0
};

/// What an output must keep to.
struct Limit
{
  int    output = 0;
  double least  = -std::numeric_limits<double>::infinity();
  double most   = std::numeric_limits<double>::infinity();
  double size   = 0.; ///< of the output, against which a breach is measured; 0: the limit's own, 1 if that is zero

  double size_at(double bound) const;
};

/// What is sought: the least sum of weight * (+-output) / scale within the limits and the box of coded variables.
struct OptimumTask
{
  std::vector<Goal>  goals{};
  std::vector<Limit> limits{};
  Eigen::VectorXd    low{}, high{}; ///< of the coded variables
};

/// Sum of weight * (+-output) / scale.
double objective_of(const std::vector<Goal> &goals, const Eigen::VectorXd &values);

/// The sum's derivatives by the variables; derivatives of outputs [outputs x variables].
Eigen::VectorXd objective_gradient(const std::vector<Goal> &goals, const Eigen::MatrixXd &derivatives);

/// The largest part of its size by which an output breaks a limit; 0 if all are kept, infinite if it is not a number.
double violation_of(const std::vector<Limit> &limits, const Eigen::VectorXd &values);

/// @throws std::invalid_argument for a task without goals, with outputs that are not there, weights, scales or limits
/// that make no
///         sense, or an empty box
void check_task(const OptimumTask &task, int n_outputs);

} // namespace gestell::apps
