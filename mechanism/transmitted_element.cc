#include "mechanism/transmitted_element.h"

#include "mechanism/require.h"

#include <algorithm>
#include <utility>

namespace gestell::mechanism
{

namespace
{
constexpr double at_rest[CombinedMeasure::max_measures + TransmittedElement::max_virtual] = {};
}

TransmittedElement::TransmittedElement(const CombinedMeasure &measure, std::shared_ptr<const ForceElement> law,
                                       double rest)
    : measure_(measure), law_(std::move(law)), rest_(rest)
{
  require(law_->n_measures() >= 1 && n_virtual() <= max_virtual, "transmitted element", "number of measures of its law",
          law_->n_measures(), "1, and at most " + std::to_string(max_virtual) + " virtual ones");
}

TransmittedElement::Seen TransmittedElement::see(const LocalMotion &motion, const double *history) const
{
  Seen       seen;
  const auto value     = measure_.evaluate(motion.u, motion.v, seen.G, of_function(motion, history));
  seen.s[0]            = value.s - rest_;
  seen.rate[0]         = value.rate;
  seen.acceleration[0] = value.bias;
  for (int i = 0; motion.a && i < n_motions(); ++i)
    seen.acceleration[0] += seen.G[i] * motion.a[i];
  for (int i = 0; i < n_virtual(); ++i)
  {
    seen.s[1 + i]            = motion.u[n_motions() + i];
    seen.rate[1 + i]         = motion.v[n_motions() + i];
    seen.acceleration[1 + i] = motion.a ? motion.a[n_motions() + i] : 0.;
  }
  return seen;
}

void TransmittedElement::spread(const Seen &seen, const double *P, double *p) const
{
  for (int i = 0; i < n_motions(); ++i)
    p[i] = P[0] * seen.G[i];
  for (int i = 0; i < n_virtual(); ++i)
    p[n_motions() + i] = P[1 + i];
}

void TransmittedElement::spread_tangent(const Seen &seen, const double *dP, double *dp) const
{
  const int  k = n_motions(), n = n_measures(), n_law = law_->n_measures();
  const auto measure = [k](int i) { return i < k ? 0 : 1 + i - k; };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      dp[i + n * j] = dP[measure(i) + n_law * measure(j)] * (i < k ? seen.G[i] : 1.) * (j < k ? seen.G[j] : 1.);
}

void TransmittedElement::start(const LocalMotion &motion, double *history) const
{
  measure_.start(motion.u, motion.v, history + law_->n_history());
  const Seen seen = see(motion, history);
  law_->start(seen.motion(motion), history);
}

void TransmittedElement::force(const LocalMotion &motion, const double *history, double *p) const
{
  const Seen seen = see(motion, history);
  double     P[max_of_law];
  law_->force(seen.motion(motion), history, P);
  spread(seen, P, p);
}

void TransmittedElement::tangent(const LocalMotion &motion, const double *history, const TangentWeights &w, double *p,
                                 double *dp) const
{
  const Seen seen = see(motion, history);
  double     P[max_of_law], dP[max_of_law * max_of_law];
  law_->tangent(seen.motion(motion), history, w, P, dP);
  spread(seen, P, p);
  spread_tangent(seen, dP, dp);
}

void TransmittedElement::derivatives(const LocalMotion &motion, const double *history, double *p, double *dp_du,
                                     double *dp_dv) const
{
  const Seen seen = see(motion, history);
  double     P[max_of_law], of_s[max_of_law * max_of_law], of_rate[max_of_law * max_of_law];
  law_->derivatives(seen.motion(motion), history, P, of_s, of_rate);
  spread(seen, P, p);
  spread_tangent(seen, of_s, dp_du);
  spread_tangent(seen, of_rate, dp_dv);
}

void TransmittedElement::engaged(const double *u, double *K, double *D) const
{
  const Seen seen = see({0., u, at_rest, at_rest}, nullptr);
  double     k[max_of_law * max_of_law], d[max_of_law * max_of_law];
  law_->engaged(seen.s, k, d);
  spread_tangent(seen, k, K);
  spread_tangent(seen, d, D);
}

void TransmittedElement::stiffest(const double *u, double *K, double *D) const
{
  const Seen seen = see({0., u, at_rest, at_rest}, nullptr);
  double     k[max_of_law * max_of_law], d[max_of_law * max_of_law];
  law_->stiffest(seen.s, k, d);
  spread_tangent(seen, k, K);
  spread_tangent(seen, d, D);
}

void TransmittedElement::geometric(const LocalMotion &motion, const double *history, double *K) const
{
  const Seen seen = see(motion, history);
  double     P[max_of_law], own[CombinedMeasure::max_measures * CombinedMeasure::max_measures] = {};
  law_->force(seen.motion(motion), history, P);
  const int k = n_motions(), n = n_measures();
  measure_.add_curvature(motion.u, -P[0], own, of_function(motion, history));
  std::fill(K, K + n * n, 0.);
  for (int j = 0; j < k; ++j)
    std::copy_n(own + k * j, k, K + n * j);
}

void TransmittedElement::accept(const LocalMotion &motion, double *history) const
{
  if (law_->n_history() == 0)
    return;
  const Seen seen = see(motion, history);
  law_->accept(seen.motion(motion), history);
}

double TransmittedElement::stored_energy(const LocalMotion &motion, const double *history) const
{
  const Seen seen = see(motion, history);
  return law_->stored_energy(seen.motion(motion), history);
}

// --- events: those of the law, then those of the position function

std::vector<Guard> TransmittedElement::guards(const double *history) const
{
  auto       guards = law_->guards(history);
  const auto own    = measure_.guards(history + law_->n_history());
  guards.insert(guards.end(), own.begin(), own.end());
  return guards;
}

void TransmittedElement::guard_values(const LocalMotion &motion, const double *history, double *g) const
{
  const Seen seen = see(motion, history);
  law_->guard_values(seen.motion(motion), history, g);
  measure_.guard_values(motion.u, history + law_->n_history(), g + law_->n_guards(history));
}

void TransmittedElement::transition(int i, const LocalMotion &motion, double *history) const
{
  const int of_law = law_->n_guards(history);
  if (i >= of_law)
  {
    measure_.transition(i - of_law, motion.u, motion.v, history + law_->n_history());
    return;
  }
  const Seen seen = see(motion, history);
  law_->transition(i, seen.motion(motion), history);
}

bool TransmittedElement::command(const std::string &order, const LocalMotion &motion, double *history) const
{
  const Seen seen = see(motion, history);
  return law_->command(order, seen.motion(motion), history);
}

double TransmittedElement::quantity(int i, const LocalMotion &motion, const double *history) const
{
  const Seen seen = see(motion, history);
  return law_->quantity(i, seen.motion(motion), history);
}

} // namespace gestell::mechanism
