#include "mechanism/measures/combined_measure.h"

#include "mechanism/require.h"

#include <cmath>
#include <utility>

namespace gestell::mechanism
{
namespace
{
constexpr double at_rest[CombinedMeasure::max_measures] = {}; ///< rates
}

CombinedMeasure::CombinedMeasure(const PlacedMeasure &measure) : CombinedMeasure({Term{1., measure}}) {}

CombinedMeasure::CombinedMeasure(std::vector<Term> terms) : CombinedMeasure(std::move(terms), PlacedMeasure(), nullptr)
{
}

CombinedMeasure::CombinedMeasure(std::vector<Term> terms, const PlacedMeasure &x,
                                 std::shared_ptr<const PositionFunction> f)
    : terms_(std::move(terms)), x_(x), f_(std::move(f))
{
  require(!terms_.empty(), "measure", "number of terms", 0., "one or more");
  for (const Term &term : terms_)
    n_measures_ += term.measure.n_measures();
  n_measures_ += x_.n_measures();
  require(n_measures_ <= max_measures, "measure", "number of motions it depends on", n_measures_,
          std::to_string(max_measures) + " or fewer");
}

CombinedMeasure::Value CombinedMeasure::argument(const double *u, const double *v, double *gradient) const
{
  const int first = first_of_x();
  return x_.evaluate(u + first, v + first, gradient + first);
}

CombinedMeasure::Value CombinedMeasure::evaluate(const double *u, const double *v, double *gradient,
                                                 const double *history) const
{
  Value sum{0., 0., 0.};
  int   first = 0;
  for (const Term &term : terms_)
  {
    const Value y = term.measure.evaluate(u + first, v + first, gradient + first);
    const int   k = term.measure.n_measures();
    for (int i = first; i < first + k; ++i)
      gradient[i] *= term.weight;
    sum.s += term.weight * y.s;
    sum.rate += term.weight * y.rate;
    sum.bias += term.weight * y.bias;
    first += k;
  }
  if (!f_)
    return sum;
  const Value x = argument(u, v, gradient);
  const auto  f = f_->at(x.s, history);
  for (int i = first; i < n_measures_; ++i)
    gradient[i] *= -f.first;
  return {sum.s - f.value, sum.rate - f.first * x.rate, sum.bias - f.first * x.bias - f.second * x.rate * x.rate};
}

void CombinedMeasure::add_curvature(const double *u, double factor, double *matrix, const double *history) const
{
  double     gradient[max_measures];
  const auto bias = [&](const double *v) { return evaluate(u, v, gradient, history).bias; };
  add_polarised<max_measures>(n_measures_, bias, factor, matrix);
}

double CombinedMeasure::size() const
{
  const auto size_of = [](const PlacedMeasure &y)
  {
    const double size = y.first.size() + y.second.size();
    return size > 0. ? size : 1.; // a coordinate itself
  };
  double size = 0.;
  for (const Term &term : terms_)
    size += std::abs(term.weight) * size_of(term.measure);
  return size;
}

const PlacedMeasure *CombinedMeasure::plain() const
{
  return terms_.size() == 1 && !f_ && terms_[0].weight == 1. ? &terms_[0].measure : nullptr;
}

double CombinedMeasure::slope(const double *u, const double *history) const
{
  double gradient[max_measures];
  return f_ ? f_->at(argument(u, at_rest, gradient).s, history).first : 0.;
}

void CombinedMeasure::start(const double *u, const double *v, double *history) const
{
  if (n_history() == 0)
    return;
  double      gradient[max_measures];
  const Value x = argument(u, v, gradient);
  f_->start(x.s, x.rate, history);
}

std::vector<Guard> CombinedMeasure::guards(const double *history) const
{
  return f_ ? f_->guards(history) : std::vector<Guard>{};
}

void CombinedMeasure::guard_values(const double *u, const double *history, double *g) const
{
  if (n_guards() == 0)
    return;
  double gradient[max_measures];
  f_->guard_values(argument(u, at_rest, gradient).s, history, g);
}

void CombinedMeasure::transition(int i, const double *u, const double *v, double *history) const
{
  double      gradient[max_measures];
  const Value x = argument(u, v, gradient);
  f_->transition(i, x.s, x.rate, history);
}

} // namespace gestell::mechanism
