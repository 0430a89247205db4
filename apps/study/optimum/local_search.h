#pragma once

#include "apps/study/optimum/output_model.h"

#include <atomic>
#include <string>

namespace gestell::apps
{

enum class SearchMethod
{
  gradient,       ///< sequential quadratic programming (SLSQP)
  derivative_free ///< models through earlier points: quadratic (BOBYQA), with constraints linear (COBYLA)
};

/// "gradient", "derivative-free".  @throws std::invalid_argument for another word (nearest named)
SearchMethod       search_method(const std::string &word);
const std::string &method_word(SearchMethod method);

struct LocalSearch
{
  SearchMethod             method = SearchMethod::gradient;
  Eigen::VectorXd          low{}, high{};           ///< box of the variables
  double                   tolerance        = 1e-6; ///< of a step in every variable, per width of the box
  int                      most_evaluations = 1000; ///< of a search
  const std::atomic<bool> *stop             = nullptr;
};

struct SearchEnd
{
  Eigen::VectorXd x{};
  std::string     reason{}; ///< "converged", "most evaluations", "rounding", "stopped", ...
};

/**
 * The smallest F_0 near `start` with F_1 <= 0, F_2 <= 0, ... inside the box.  Functions return F as values, with their
 * derivatives if the method wants them; F should be of the size of one.  Values that are not finite count as bad
 * places.
 *
 * @throws std::invalid_argument if a gradient method gets no derivatives; what `functions` throws
 * Source: Kraft, ACM Trans. Math. Softw. 20 (1994) 262-281; Powell, in: Advances in Optimization and Numerical Analysis
 * (1994) 51-67, and DAMTP 2009/NA06; NLopt of Johnson
 */
SearchEnd local_search(const OutputModel &functions, int n_constraints, const Eigen::VectorXd &start,
                       const LocalSearch &search);

} // namespace gestell::apps
