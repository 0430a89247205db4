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

TransmittedElement::TransmittedElement(const CombinedMeasure &measure, std::shared_ptr<const ForceLaw> law, double rest)
    : measures_{measure}, law_(std::move(law)), rest_(rest)
{
  require(law_->n_measures() >= 1 && n_virtual() <= max_virtual, "transmitted element", "number of measures of its law",
          law_->n_measures(), "1, and at most " + std::to_string(max_virtual) + " virtual ones");
}

TransmittedElement::TransmittedElement(const Placement &first, const Placement &second,
                                       const std::vector<RelativeMeasure> &measures,
                                       std::shared_ptr<const ForceLaw>     law)
    : law_(std::move(law)), rest_(0.)
{
  for (const RelativeMeasure &measure : measures)
    measures_.emplace_back(PlacedMeasure{first, second, measure});
  require(!measures.empty() && n_virtual() == 0, "transmitted element", "number of measures of its law",
          law_->n_measures(), std::to_string(n_seen()));
  require(n_seen() <= max_seen, "transmitted element", "number of measures of its law", n_seen(),
          "at most " + std::to_string(max_seen));
}

double TransmittedElement::size_of_terms() const
{
  double size = law_->size_of_terms();
  for (const CombinedMeasure &measure : measures_)
  {
    const PlacedMeasure *plain = measure.plain();
    size                       = std::max(size, plain ? plain->first.size() + plain->second.size() : measure.size());
  }
  return size;
}

TransmittedElement::Kinematics TransmittedElement::kinematics_of(const LocalMotion &motion, const double *history) const
{
  Kinematics kinematics;
  const int  k = n_motions(), m = n_seen();
  for (int i = 0; i < m; ++i)
  {
    double    *G               = kinematics.G + k * i;
    const auto value           = measures_[i].evaluate(motion.u, motion.v, G, of_function(motion, history));
    kinematics.s[i]            = value.s;
    kinematics.rate[i]         = value.rate;
    kinematics.acceleration[i] = value.bias;
    for (int j = 0; motion.a && j < k; ++j)
      kinematics.acceleration[i] += G[j] * motion.a[j];
  }
  kinematics.s[0] -= rest_;
  for (int i = 0; i < n_virtual(); ++i)
  {
    kinematics.s[m + i]            = motion.u[k + i];
    kinematics.rate[m + i]         = motion.v[k + i];
    kinematics.acceleration[m + i] = motion.a ? motion.a[k + i] : 0.;
  }
  return kinematics;
}

void TransmittedElement::spread(const Kinematics &kinematics, const double *P, double *p) const
{
  const int k = n_motions(), m = n_seen();
  for (int j = 0; j < k; ++j)
  {
    p[j] = 0.;
    for (int i = 0; i < m; ++i)
      p[j] += P[i] * kinematics.G[j + k * i];
  }
  for (int i = 0; i < n_virtual(); ++i)
    p[k + i] = P[m + i];
}

void TransmittedElement::spread_tangent(const Kinematics &kinematics, const double *dP, double *dp) const
{
  const int k = n_motions(), m = n_seen(), n = n_measures(), n_law = law_->n_measures();
  for (int j = 0; j < n; ++j)
  {
    double column[max_of_law] = {}; // dP ds/du_j
    for (int b = 0; b < n_law; ++b)
      if (const double ds = j < k ? (b < m ? kinematics.G[j + k * b] : 0.) : (b == m + j - k ? 1. : 0.); ds != 0.)
        for (int a = 0; a < n_law; ++a)
          column[a] += dP[a + n_law * b] * ds;
    spread(kinematics, column, dp + n * j);
  }
}

void TransmittedElement::start(const LocalMotion &motion, double *history) const
{
  function().start(motion.u, motion.v, history + n_of_law_);
  if (!branches_)
    return;
  const Kinematics kinematics = kinematics_of(motion, history);
  branches_->start(kinematics.motion(motion), history);
}

void TransmittedElement::resume(const LocalMotion &motion, double *history) const
{
  function().start(motion.u, motion.v, history + n_of_law_);
  if (!branches_)
    return;
  const Kinematics kinematics = kinematics_of(motion, history);
  branches_->resume(kinematics.motion(motion), history);
}

void TransmittedElement::force(const LocalMotion &motion, const double *history, double *p) const
{
  const Kinematics kinematics = kinematics_of(motion, history);
  double           P[max_of_law];
  law_->force(kinematics.motion(motion), history, P);
  spread(kinematics, P, p);
}

void TransmittedElement::tangent(const LocalMotion &motion, const double *history, const TangentWeights &w, double *p,
                                 double *dp) const
{
  const Kinematics kinematics = kinematics_of(motion, history);
  double           P[max_of_law], dP[max_of_law * max_of_law];
  law_->tangent(kinematics.motion(motion), history, w, P, dP);
  spread(kinematics, P, p);
  spread_tangent(kinematics, dP, dp);
}

void TransmittedElement::derivatives(const LocalMotion &motion, const double *history, double *p, double *dp_du,
                                     double *dp_dv) const
{
  const Kinematics kinematics = kinematics_of(motion, history);
  double           P[max_of_law], of_s[max_of_law * max_of_law], of_rate[max_of_law * max_of_law];
  law_->derivatives(kinematics.motion(motion), history, P, of_s, of_rate);
  spread(kinematics, P, p);
  spread_tangent(kinematics, of_s, dp_du);
  spread_tangent(kinematics, of_rate, dp_dv);
}

void TransmittedElement::spread_structure(Matrices matrices, const double *u, double *K, double *D) const
{
  const Kinematics kinematics = kinematics_of({0., u, at_rest, at_rest}, nullptr);
  double           k[max_of_law * max_of_law], d[max_of_law * max_of_law];
  matrices(*law_, kinematics.s, k, d);
  spread_tangent(kinematics, k, K);
  spread_tangent(kinematics, d, D);
}

void TransmittedElement::engaged(const double *u, double *K, double *D) const
{
  spread_structure(mechanism::engaged, u, K, D);
}

void TransmittedElement::stiffest(const double *u, double *K, double *D) const
{
  spread_structure(mechanism::stiffest, u, K, D);
}

void TransmittedElement::open_branch(const double *u, double *K, double *D) const
{
  spread_structure(mechanism::open_branch, u, K, D);
}

void TransmittedElement::geometric(const LocalMotion &motion, const double *history, double *K) const
{
  const Kinematics kinematics = kinematics_of(motion, history);
  const int        k = n_motions(), n = n_measures(), n_law = law_->n_measures();
  double           P[max_of_law], of_s[max_of_law * max_of_law], of_rate[max_of_law * max_of_law];
  law_->derivatives(kinematics.motion(motion), history, P, of_s, of_rate);
  for (int b = 0; b < n_seen(); ++b)
  {
    double S[CombinedMeasure::max_measures * CombinedMeasure::max_measures] = {}; // s_b''
    measures_[b].add_curvature(motion.u, 1., S, of_function(motion, history));
    for (int j = 0; j < k; ++j)
    {
      double turned = 0., column[CombinedMeasure::max_measures + max_virtual]; // of s_b' by u_j
      for (int i = 0; i < k; ++i)
      {
        K[i + n * j] -= P[b] * S[i + k * j];
        turned += S[i + k * j] * motion.v[i];
      }
      if (turned == 0.)
        continue;
      spread(kinematics, of_rate + n_law * b, column);
      for (int i = 0; i < n; ++i)
        K[i + n * j] -= column[i] * turned;
    }
  }
}

void TransmittedElement::accept(const LocalMotion &motion, double *history) const
{
  if (n_of_law_ == 0)
    return;
  const Kinematics kinematics = kinematics_of(motion, history);
  branches_->accept(kinematics.motion(motion), history);
}

double TransmittedElement::stored_energy(const LocalMotion &motion, const double *history) const
{
  const Kinematics kinematics = kinematics_of(motion, history);
  return law_->stored_energy(kinematics.motion(motion), history);
}

double TransmittedElement::stored_power(const LocalMotion &motion, const double *history) const
{
  const Kinematics kinematics = kinematics_of(motion, history);
  return law_->stored_power(kinematics.motion(motion), history);
}

double TransmittedElement::penetration(const LocalMotion &motion) const
{
  if (!structure_)
    return 0.;
  const Kinematics kinematics = kinematics_of(motion, nullptr);
  return structure_->penetration(kinematics.motion(motion));
}

/// s of the law as a function of the measures: s'' = G (g u'' + b), with the law's gradient G and b of the measures.
Play TransmittedElement::play(const double *u, const double *v, double *G) const
{
  if (!structure_)
    return {};
  const Kinematics kinematics                          = kinematics_of({0., u, v, at_rest}, nullptr);
  double           own[Play::max_motions * max_of_law] = {};
  Play             play                                = structure_->play(kinematics.s, kinematics.rate, own);
  const int        n_law = law_->n_measures(), n = n_measures();
  for (int i = 0; i < play.n; ++i)
  {
    spread(kinematics, own + n_law * i, G + n * i);
    for (int j = 0; j < n_seen(); ++j)
      play.bias[i] += own[j + n_law * i] * kinematics.acceleration[j];
  }
  return play;
}

// --- events of the law, followed by those of the position function

std::vector<Guard> TransmittedElement::guards(const double *history) const
{
  auto       guards = branches_ ? branches_->guards(history) : std::vector<Guard>{};
  const auto own    = function().guards(history + n_of_law_);
  guards.insert(guards.end(), own.begin(), own.end());
  return guards;
}

void TransmittedElement::guard_values(const LocalMotion &motion, const double *history, double *g) const
{
  if (branches_)
  {
    const Kinematics kinematics = kinematics_of(motion, history);
    branches_->guard_values(kinematics.motion(motion), history, g);
  }
  function().guard_values(motion.u, history + n_of_law_, g + n_guards_of_law(history));
}

void TransmittedElement::transition(int i, const LocalMotion &motion, double *history) const
{
  const int of_law = n_guards_of_law(history);
  if (i >= of_law)
  {
    function().transition(i - of_law, motion.u, motion.v, history + n_of_law_);
    return;
  }
  const Kinematics kinematics = kinematics_of(motion, history);
  branches_->transition(i, kinematics.motion(motion), history);
}

bool TransmittedElement::command(const SwitchCommand &order, const LocalMotion &motion, double *history) const
{
  const Kinematics kinematics = kinematics_of(motion, history);
  return commands_->command(order, kinematics.motion(motion), history);
}

double TransmittedElement::quantity(int i, const LocalMotion &motion, const double *history) const
{
  const Kinematics kinematics = kinematics_of(motion, history);
  return law_->quantity(i, kinematics.motion(motion), history);
}

} // namespace gestell::mechanism
