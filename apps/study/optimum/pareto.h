#pragma once

#include "apps/study/optimum/optimum.h"

namespace gestell::apps
{

/// Rows that no other row dominates: none is as good in all columns and better in one.  Of equal rows the first; rows
/// with a value that is not finite are none.  By the first column, best first.
/// @param values [rows x senses]
std::vector<int> nondominated(const Eigen::MatrixXd &values, const std::vector<Sense> &senses);

struct ParetoPoint
{
  Eigen::VectorXd coded{};
  Eigen::VectorXd values{}; ///< of all outputs of the model
};

struct ParetoOptions
{
  int           points  = 21;   ///< about as many on the front of two goals; of more, of all their weights
  int           samples = 4096; ///< Sobol points, and the corners, from which the searches begin
  std::uint64_t seed    = 1;
};

/**
 * Front of a task with two or more goals on a model that costs nothing, such as surfaces.  For weights w spread over
 * all goals it minimises, from the best sample,
 *
 *     max_i w_i (f_i - f_i*) / (f_i^ - f_i*)      f*, f^: best and worst of goal i on the samples' front,
 *
 * which finds the points of concave parts of the front, too, that no weighted sum has as its minimum.  What is
 * dominated is left out.
 *
 * @return ordered by the first goal, best first; empty if no sample keeps the limits
 * @throws std::invalid_argument for fewer than two goals, and as find_optimum
 * Source: Miettinen, Nonlinear Multiobjective Optimization (1999), 3.4; docs/theory/response_surfaces.md (12)
 */
std::vector<ParetoPoint> pareto_front(const OutputModel &model, const OptimumTask &task,
                                      const ParetoOptions &options = {});

} // namespace gestell::apps
