#include "apps/analysis/life/life_twins.h"

#include "apps/analysis/life/life_damage.h"
#include "apps/session/sensitivity/sensitivity_keys.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gestell::apps
{
namespace
{

/// Damage at a place in a scene with changed keys.
double twin_damage(Session &session, const std::vector<std::string> &changes, const LifePlace &place)
{
  Variant variant = session.variant();
  for (const std::string &change : changes)
    variant.set(change);
  Session      twin(std::move(variant), {session.progress(), session.interruption()});
  const Result result = twin.run();
  if (!result.run->failure.empty() || result.run->interrupted)
    throw std::runtime_error("the run with " + changes.front() + " did not finish: " + result.run->failure);
  const coupling::ReducedFrame &frame  = *twin.machine().machine.model().reduced_frame();
  const double                  damage = damage_at(twin.scene(), frame, life_load(twin, *result.run), place);
  return damage > 0. ? damage
                     : throw std::runtime_error("the run with " + changes.front() + " causes no damage at this point");
}

double life_factor(double a, double b)
{
  return std::exp(std::abs(std::log(a / b)));
}

std::string entry(const std::string &key, double value)
{
  return key + '=' + exact_text(value);
}

} // namespace

void refine_error(Session &session, LifeResult &found)
{
  const LifePlace *worst = found.worst();
  if (!worst || !(worst->damage > 0.))
    return;
  const coupling::MethodOptions &method = session.scene().run.options.method;
  const int                      modes  = int(session.machine().machine.model().reduced_frame()->omega0.size());
  constexpr int                  fewest = 8; // more modes, as in the budget of outputs
  LifeError                     &error  = found.places.front().error;
  const bool                     fixed  = method.tolerance == 0.;
  const double                   finer  = twin_damage(
                         session, {fixed ? entry("run.step", 0.5 * method.step) : entry("run.tolerance", method.tolerance / 16.)}, *worst);
  error.time = std::pow(life_factor(finer, worst->damage), 4. / 3.);
  const double more =
      twin_damage(session, {"reduction.modes=" + std::to_string(modes + std::max(fewest, modes / 2))}, *worst);
  error.modes   = life_factor(more, worst->damage);
  found.refined = true;
}

std::vector<LifeDerivative> life_derivatives(Session &session, const LifeResult &found, const std::string &keys)
{
  constexpr double            share = 1e-3, smooth = 0.01; // of the key; of the derivative
  std::vector<LifeDerivative> derivatives;
  const LifePlace            *worst = found.worst();
  if (!worst || !(worst->damage > 0.))
    return derivatives;
  for (const VariedKey &key : varied_keys(session.variant().root, keys))
  {
    const double steps = share * std::abs(key.reported.value) / key.step;
    const auto   slope = [&](double by)
    {
      const double above = twin_damage(session, {key.overridden(by * steps)}, *worst);
      const double below = twin_damage(session, {key.overridden(-by * steps)}, *worst);
      return -std::log(above / below) / (2. * by * share);
    };
    const double   near = slope(1.), far = slope(2.);
    const double   value = near + (near - far) / 3.; // without the term of second order
    LifeDerivative own{key.reported.key, value, ""};
    if (std::abs(near - far) > smooth * std::max(std::abs(near), std::abs(far)))
      own.note = "not smooth: " + short_text(far, 3) + " with twice the step; cycles appear or vanish";
    derivatives.push_back(std::move(own));
  }
  return derivatives;
}

} // namespace gestell::apps
