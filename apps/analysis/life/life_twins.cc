#include "apps/analysis/life/life_twins.h"

#include "apps/analysis/life/life_damage.h"
#include "apps/session/sensitivity/sensitivity_keys.h"
#include "apps/sizing/model_variant.h"
#include "apps/sizing/size_laws.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace gestell::apps
{
namespace
{

/// Cycles with damage at a place, by damage.
struct TwinDamage
{
  std::vector<double> cycles;

  double total() const { return std::accumulate(cycles.begin(), cycles.end(), 0.); }
};

/// A scene with changed keys, integrated in another way.
class Twin
{
public:
  Twin(Session &session, const std::vector<std::string> &changes, Integration integration = {})
      : integration_(std::move(integration)), session_(changed(session, changes, integration_)), result_(session_.run())
  {
    if (!result_.run->failure.empty() || result_.run->interrupted)
      throw std::runtime_error((changes.empty() ? "the finer run" : "the run with " + changes.front()) +
                               " did not finish: " + result_.run->failure);
  }

  const coupling::ReducedFrame &frame() { return *session_.machine().machine.model().reduced_frame(); }
  TwinDamage                    damage(const LifePlace &place)
  {
    const LifeLoad load = life_load(session_, *result_.run, integration_);
    TwinDamage     there{damages_at(session_.scene(), frame(), load, place)};
    there.cycles.erase(std::remove(there.cycles.begin(), there.cycles.end(), 0.), there.cycles.end());
    std::sort(there.cycles.begin(), there.cycles.end(), std::greater<>());
    return there;
  }

private:
  static Session changed(Session &session, const std::vector<std::string> &changes, const Integration &integration)
  {
    Variant variant = session.variant();
    for (const std::string &change : changes)
      variant.set(change);
    Scene scene = variant.scene();
    if (integration)
      integrate_by(integration, scene);
    return Session(std::move(variant), std::move(scene), {session.progress(), session.interruption()});
  }

  Integration integration_;
  Session     session_;
  Result      result_;
};

/// A finer integration, as that of the budget of outputs.
struct FinerTime
{
  Integration integration;
  double      power = 1.; ///< of the factor on life between both runs
  TwinDamage  damage{};
};

/// By `exact` of order 8; for machines that it cannot integrate by half the step or a sixteenth of the tolerance.
FinerTime finer_time(Session &session, const LifePlace &place)
{
  FinerTime finer{finest_method};
  try
  {
    finer.damage = Twin(session, {}, finer.integration).damage(place);
  }
  catch (const std::exception &)
  {
    if (session.interruption() && *session.interruption())
      throw;
    constexpr double of_order_2 = 4. / 3.; // errors of half the step are a quarter
    finer        = {[](const Scene &scene) { return finer_method(scene.run.options.method); }, of_order_2};
    finer.damage = Twin(session, {}, finer.integration).damage(place);
  }
  return finer;
}

double life_factor(double a, double b)
{
  return a == b ? 1. : std::exp(std::abs(std::log(a / b)));
}

constexpr double step_of_key = 5e-3; ///< of its value: rounding of 1e-6 in a damage leaves 2e-4 of the derivative

/// Damage for changes of a key by -2 to 2 steps.
using Damages = std::array<TwinDamage, 5>;

/// What the cycles without counterpart in all runs are of the change of the damage.
double share_of_other_cycles(const Damages &damages)
{
  std::size_t common = damages.front().cycles.size();
  for (const TwinDamage &one : damages)
    common = std::min(common, one.cycles.size());
  double most = 0.;
  for (const TwinDamage &one : damages)
    most = std::max(most, std::accumulate(one.cycles.begin() + std::ptrdiff_t(common), one.cycles.end(), 0.));
  return most > 0. ? most / std::abs(damages.back().total() - damages.front().total()) : 0.;
}

void differentiate(const Damages &damages, LifeDerivative &own)
{
  std::array<double, 5> life{};
  for (std::size_t i = 0; i < life.size(); ++i)
    life[i] = -std::log(damages[i].total());
  const double     near = (life[3] - life[1]) / (2. * step_of_key), far = (life[4] - life[0]) / (4. * step_of_key);
  constexpr double of_noise = 8.4; // fourth difference of equal independent errors: sqrt(1 + 16 + 36 + 16 + 1)
  const double     noise    = std::abs(life[0] - 4. * life[1] + 6. * life[2] - 4. * life[3] + life[4]) / of_noise;
  own.exponent              = near + (near - far) / 3.;
  own.error                 = std::abs(near - far) / 3. + noise / step_of_key;
  constexpr double believed = 1e-3;            // of the derivative
  constexpr double smooth = 0.01, least = 0.1; // of the derivative; one below does not change a life
  const double     far_away = 100. * 2. * step_of_key;
  if (share_of_other_cycles(damages) > believed)
    own.note = "cycles with damage appear or vanish: " + std::to_string(damages.front().cycles.size()) + " at -" +
               short_text(far_away) + " %, " + std::to_string(damages.back().cycles.size()) + " at +" +
               short_text(far_away) + " %";
  else if (own.error > smooth * std::max(least, std::abs(own.exponent)))
    own.note = "not smooth: " + short_text(near, 3) + " within " + short_text(0.5 * far_away) + " %, " +
               short_text(far, 3) + " within " + short_text(far_away) + " %";
}

} // namespace

void refine_error(Session &session, const LifeLoad &load, LifeResult &found)
{
  const LifePlace *worst = found.worst();
  if (!worst || !(worst->damage > 0.))
    return;
  LifeError      &error     = found.places.front().error;
  const auto     &frame     = *session.machine().machine.model().reduced_frame();
  const FinerTime finer_run = finer_time(session, *worst);
  error.time  = std::pow(life_factor(finer_run.damage.total(), worst->damage), finer_run.power / found_between_samples);
  error.modes = 1.;
  const int modes = int(frame.omega0.size()), most = frame.n_full - frame.n_interface;
  if (modes < most)
  {
    const int                 more = std::min(most, more_than(modes));
    Twin                      finer(session, {"reduction.modes=" + std::to_string(more)});
    const std::vector<double> own = damages_at(session.scene(), frame, load, *worst);
    const double              rest =
        more < most ? truncation_factor(finer.frame().omega0, modes, truncation_power(true, false)) : 1.;
    error.modes =
        std::pow(life_factor(finer.damage(*worst).total(), std::accumulate(own.begin(), own.end(), 0.)), rest);
  }
  found.refined = true;
}

std::vector<LifeDerivative> life_derivatives(Session &session, const LifeResult &found, const std::string &keys)
{
  std::vector<LifeDerivative> derivatives;
  const LifePlace            *worst = found.worst();
  if (!worst || !(worst->damage > 0.))
    return derivatives;
  const FinerTime finer = finer_time(session, *worst);
  Damages         damages;
  damages[2] = finer.damage;
  for (const VariedKey &key : varied_keys(session.variant().root, keys))
  {
    LifeDerivative own{key.reported.key};
    const double   steps = step_of_key * key.reported.value / key.step; // of a negative value, away from zero
    try
    {
      for (const int i : {0, 1, 3, 4})
      {
        const std::string change = key.overridden((i - 2) * steps);
        damages[std::size_t(i)]  = Twin(session, {change}, finer.integration).damage(*worst);
        if (damages[std::size_t(i)].cycles.empty())
          throw std::runtime_error("the run with " + change + " causes no damage at this point");
      }
      differentiate(damages, own);
    }
    catch (const std::exception &failure) // also a value that the scene refuses, such as another notch class
    {
      if (session.interruption() && *session.interruption())
        throw;
      own.note = std::string("no derivative: ") + failure.what();
    }
    derivatives.push_back(std::move(own));
  }
  return derivatives;
}

} // namespace gestell::apps
