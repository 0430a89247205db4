#include "apps/study/optimum/local_search.h"

#include "apps/study/values/word_choice.h"

#include <nlopt.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <memory>
#include <stdexcept>

namespace gestell::apps
{
namespace
{

const std::vector<std::string> method_words = {"gradient", "derivative-free"}; ///< as SearchMethod

/// What NLopt calls back, for one search.
struct Talk
{
  const OutputModel &functions;
  const LocalSearch &search;
  nlopt_opt          optimiser = nullptr;
  double             worst     = 1.; ///< of all finite F_0
  std::exception_ptr failure{};
};

struct Function
{
  Talk *talk;
  int   row;
};

/// A search by gradients asks for them at every point, as most steps are taken: one run, not two.
OutputPoint functions_at(Talk &talk, unsigned n, const double *x)
{
  const bool  by_gradients = talk.search.method == SearchMethod::gradient;
  OutputPoint point =
      talk.functions(Eigen::Map<const Eigen::VectorXd>(x, n), by_gradients ? Derivatives::wanted : Derivatives::none);
  if (by_gradients && point.derivatives.size() == 0)
    throw std::invalid_argument("study: the outputs have no derivatives for a search by gradients; use method "
                                "\"derivative-free\", or search on the surface");
  return point;
}

/// A value that is worse than all before it where there is none.
double tamed(Talk &talk, double value)
{
  if (!std::isfinite(value))
    return 2. * talk.worst + 1.;
  talk.worst = std::max(talk.worst, std::abs(value));
  return value;
}

void copy_slopes(const OutputPoint &point, int row, double *gradient, unsigned n)
{
  const auto finite_or_zero                = [](double slope) { return std::isfinite(slope) ? slope : 0.; };
  Eigen::Map<Eigen::VectorXd>(gradient, n) = point.derivatives.row(row).transpose().unaryExpr(finite_or_zero);
}

double call(unsigned n, const double *x, double *gradient, void *context)
{
  const Function &function = *static_cast<Function *>(context);
  Talk           &talk     = *function.talk;
  if (talk.search.stop && *talk.search.stop)
    nlopt_force_stop(talk.optimiser);
  else
    try
    {
      const OutputPoint point = functions_at(talk, n, x);
      if (gradient)
        copy_slopes(point, function.row, gradient, n);
      return tamed(talk, point.values(function.row));
    }
    catch (...) // must not pass through a library in C
    {
      talk.failure = std::current_exception();
      nlopt_force_stop(talk.optimiser);
    }
  return talk.worst;
}

std::string reason_of(nlopt_result result)
{
  switch (result)
  {
  case NLOPT_MAXEVAL_REACHED:
    return "most evaluations";
  case NLOPT_FORCED_STOP:
    return "stopped";
  case NLOPT_ROUNDOFF_LIMITED:
    return "rounding";
  default:
    return result > 0 ? "converged" : "failed";
  }
}

/// BOBYQA takes no constraints, and two variables at least.
nlopt_algorithm algorithm_of(SearchMethod method, Eigen::Index n_variables, int n_constraints)
{
  if (method == SearchMethod::gradient)
    return NLOPT_LD_SLSQP;
  return n_constraints == 0 && n_variables > 1 ? NLOPT_LN_BOBYQA : NLOPT_LN_COBYLA;
}

void set_limits(nlopt_opt optimiser, const LocalSearch &search)
{
  constexpr double      first_simplex = 0.25; // of the box' width: two steps from its middle to a wall
  const Eigen::VectorXd width = search.high - search.low, step = first_simplex * width,
                        tolerance = search.tolerance * width;
  nlopt_set_lower_bounds(optimiser, search.low.data());
  nlopt_set_upper_bounds(optimiser, search.high.data());
  nlopt_set_xtol_abs(optimiser, tolerance.data());
  nlopt_set_maxeval(optimiser, search.most_evaluations);
  nlopt_set_initial_step(optimiser, step.data());
}

} // namespace

SearchMethod search_method(const std::string &word)
{
  return static_cast<SearchMethod>(word_choice(word, method_words, "search method"));
}

const std::string &method_word(SearchMethod method)
{
  return method_words[static_cast<std::size_t>(method)];
}

SearchEnd local_search(const OutputModel &functions, int n_constraints, const Eigen::VectorXd &start,
                       const LocalSearch &search)
{
  using Optimiser = std::unique_ptr<std::remove_pointer_t<nlopt_opt>, decltype(&nlopt_destroy)>;
  const Optimiser optimiser(
      nlopt_create(algorithm_of(search.method, start.size(), n_constraints), static_cast<unsigned>(start.size())),
      &nlopt_destroy);
  set_limits(optimiser.get(), search);

  Talk                  talk{functions, search, optimiser.get()};
  std::vector<Function> rows;
  for (int row = 0; row <= n_constraints; ++row)
    rows.push_back({&talk, row});
  nlopt_set_min_objective(optimiser.get(), call, &rows[0]);
  constexpr double constraint_tolerance = 1e-9; // of F_i <= 0, which are of the size of one
  for (int row = 1; row <= n_constraints; ++row)
    nlopt_add_inequality_constraint(optimiser.get(), call, &rows[row], constraint_tolerance);

  SearchEnd end;
  end.x            = start.cwiseMax(search.low).cwiseMin(search.high);
  double     least = 0.;
  const auto code  = nlopt_optimize(optimiser.get(), end.x.data(), &least);
  if (talk.failure)
    std::rethrow_exception(talk.failure);
  end.reason = reason_of(code);
  return end;
}

} // namespace gestell::apps
