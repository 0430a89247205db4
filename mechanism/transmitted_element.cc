#include "mechanism/transmitted_element.h"

#include "mechanism/require.h"

#include <algorithm>
#include <utility>

namespace gestell::mechanism
{

namespace
{
constexpr double at_rest[PlacedMeasure::max_measures] = {};
}

TransmittedElement::TransmittedElement(const PlacedMeasure &measure, std::shared_ptr<const ForceElement> law,
                                       double rest)
    : measure_(measure), law_(std::move(law)), rest_(rest)
{
  require(law_->n_measures() == 1, "transmitted element", "number of measures of its law", law_->n_measures(), "1");
}

TransmittedElement::Seen TransmittedElement::see(const LocalMotion &motion) const
{
  Seen       seen;
  const auto value  = measure_.evaluate(motion.u, motion.v, seen.G);
  seen.s            = value.s - rest_;
  seen.rate         = value.rate;
  seen.acceleration = value.bias;
  for (int i = 0; motion.a && i < n_measures(); ++i)
    seen.acceleration += seen.G[i] * motion.a[i];
  return seen;
}

void TransmittedElement::spread(const Seen &seen, double factor, double *matrix) const
{
  const int k = n_measures();
  for (int j = 0; j < k; ++j)
    for (int i = 0; i < k; ++i)
      matrix[i + k * j] = factor * seen.G[i] * seen.G[j];
}

void TransmittedElement::start(const LocalMotion &motion, double *history) const
{
  const Seen seen = see(motion);
  law_->start(seen.motion(motion), history);
}

void TransmittedElement::force(const LocalMotion &motion, const double *history, double *p) const
{
  const Seen seen = see(motion);
  double     P;
  law_->force(seen.motion(motion), history, &P);
  for (int i = 0; i < n_measures(); ++i)
    p[i] = P * seen.G[i];
}

void TransmittedElement::tangent(const LocalMotion &motion, const double *history, const TangentWeights &w, double *p,
                                 double *dp) const
{
  const Seen seen = see(motion);
  double     P, dP;
  law_->tangent(seen.motion(motion), history, w, &P, &dP);
  for (int i = 0; i < n_measures(); ++i)
    p[i] = P * seen.G[i];
  spread(seen, dP, dp);
}

void TransmittedElement::derivatives(const LocalMotion &motion, const double *history, double *p, double *dp_du,
                                     double *dp_dv) const
{
  const Seen seen = see(motion);
  double     P, P_s, P_rate;
  law_->derivatives(seen.motion(motion), history, &P, &P_s, &P_rate);
  for (int i = 0; i < n_measures(); ++i)
    p[i] = P * seen.G[i];
  spread(seen, P_s, dp_du);
  spread(seen, P_rate, dp_dv);
}

void TransmittedElement::engaged(const double *u, double *K, double *D) const
{
  const Seen seen = see({0., u, at_rest, at_rest});
  double     k, d;
  law_->engaged(&seen.s, &k, &d);
  spread(seen, k, K);
  spread(seen, d, D);
}

void TransmittedElement::stiffest(const double *u, double *K, double *D) const
{
  const Seen seen = see({0., u, at_rest, at_rest});
  double     k, d;
  law_->stiffest(&seen.s, &k, &d);
  spread(seen, k, K);
  spread(seen, d, D);
}

void TransmittedElement::geometric(const LocalMotion &motion, const double *history, double *K) const
{
  const Seen seen = see(motion);
  double     P;
  law_->force(seen.motion(motion), history, &P);
  std::fill(K, K + n_measures() * n_measures(), 0.);
  measure_.add_curvature(motion.u, -P, K);
}

void TransmittedElement::accept(const LocalMotion &motion, double *history) const
{
  if (law_->n_history() == 0)
    return;
  const Seen seen = see(motion);
  law_->accept(seen.motion(motion), history);
}

double TransmittedElement::stored_energy(const LocalMotion &motion, const double *history) const
{
  const Seen seen = see(motion);
  return law_->stored_energy(seen.motion(motion), history);
}

void TransmittedElement::guard_values(const LocalMotion &motion, const double *history, double *g) const
{
  const Seen seen = see(motion);
  law_->guard_values(seen.motion(motion), history, g);
}

void TransmittedElement::transition(int i, const LocalMotion &motion, double *history) const
{
  const Seen seen = see(motion);
  law_->transition(i, seen.motion(motion), history);
}

bool TransmittedElement::command(const std::string &order, const LocalMotion &motion, double *history) const
{
  const Seen seen = see(motion);
  return law_->command(order, seen.motion(motion), history);
}

double TransmittedElement::quantity(int i, const LocalMotion &motion, const double *history) const
{
  const Seen seen = see(motion);
  return law_->quantity(i, seen.motion(motion), history);
}

} // namespace gestell::mechanism
