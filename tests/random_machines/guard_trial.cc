#include "tests/random_machines/guard_trial.h"

#include "tests/random_machines/dice.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace gestell::tests
{
namespace
{

constexpr int most_steps = 20000, few_steps = 2000;
/// Energy of a stable method swings by 1/(1 - (omega h/2)^2) at most, except just below its limit.
constexpr double growth = 100.;

coupling::MethodOptions random_method(Dice &dice, bool jointed)
{
  static const char *const free[] = {
      "bdf", "bdf", "newmark", "wilson", "hht", "generalised-alpha", "central-difference"};
  static const char *const held[] = {"bdf", "bdf", "hht", "generalised-alpha"};

  coupling::MethodOptions options;
  options.method = jointed ? held[dice.whole(4)] : free[dice.whole(7)];
  options.order  = 1 + dice.whole(6);
  options.set("beta", dice.between(0., 0.4));
  options.set("gamma", dice.chance(0.6) ? 0.5 : dice.between(0.5, 0.8));
  options.set("theta", dice.between(1., 2.));
  options.set("alpha", dice.between(-1. / 3., jointed ? -0.01 : 0.));
  options.set("rho_inf", dice.between(0., jointed ? 0.99 : 1.));
  return options;
}

/// How much the largest energy of the last third exceeds that of the first.
double energy_growth(const Told &reported)
{
  const int column = reported.column("energy stored"), n = reported.n_rows();
  double    early = 0., late = 0.;
  for (int i = 0; i < n; ++i)
    if (const double now = std::abs(reported.at(i, column)); 3 * i < n)
      early = std::max(early, now);
    else if (3 * i > 2 * n)
      late = std::max(late, now);
  return late / early; // nan of a machine at rest
}

class GuardTrial
{
public:
  GuardTrial(const RandomMachine &machine, const Trial &trial, double &cpu_s) : trial_(trial), cpu_s_(cpu_s)
  {
    Dice dice(machine.seed ^ 0x5eedu);
    options_      = random_method(dice, machine.jointed);
    options_.step = dice.log_between(0.05, 5.) / trial.fastest();
  }

  std::vector<Finding> findings()
  {
    coupling::Machine model = apps::build_machine(trial_.scene());
    spectrum_               = coupling::linear_spectrum(model, trial_.initial());
    const coupling::StabilityGuard guard(spectrum_, options_);
    double                         radius = 0.;
    for (const coupling::ModeAccuracy &mode : guard.modes())
      if (mode.unstable)
        radius = std::max(radius, mode.spectral_radius);
    if (radius > 0.)
      refused(radius);
    else
      let_pass(options_, "guard let pass what grows");
    return findings_;
  }

private:
  Told forced(coupling::MethodOptions options, double steps)
  {
    const Told reported = trial_.forced(options, steps);
    cpu_s_ += reported.cpu_s;
    return reported;
  }

  void find(const std::string &kind, const coupling::MethodOptions &options, double value, double bound)
  {
    char step[64];
    std::snprintf(step, sizeof step, "step = %.12g, fastest omega h = %.4g", options.step,
                  options.step * trial_.fastest());
    findings_.push_back({kind, coupling::method_name(options), step, value, bound});
  }

  /// Nothing, of a machine at rest.
  static std::optional<bool> grew(const Told &reported, double factor)
  {
    const double grown = energy_growth(reported);
    if (std::isnan(grown) && reported.run.failure.empty())
      return {};
    return !reported.run.failure.empty() || !(grown < factor);
  }

  /// A body that nothing moves holds modes that no motion shows.
  static bool has_body_at_rest(const Told &reported)
  {
    return std::any_of(reported.run.signals.begin(), reported.run.signals.end(),
                       [](const coupling::SignalSummary &signal)
                       {
                         const std::string quantity = signal.name.substr(signal.name.rfind('.') + 1);
                         return (quantity == "speed" || quantity == "velocity") && signal.min == 0. && signal.max == 0.;
                       });
  }

  void refused(double radius)
  {
    // The mode may begin with a millionth of the motion.
    const double steps = 3. * std::log(1e6 * growth) / std::log(radius);
    if (steps < most_steps)
      if (const Told reported = forced(options_, std::max(100., steps));
          !grew(reported, growth).value_or(true) && !has_body_at_rest(reported))
        find("guard refused what does not grow", options_, radius, 1.);
    coupling::MethodOptions offered = options_;
    offered.step                    = coupling::StabilityGuard(spectrum_, options_).largest_stable_step();
    if (!(offered.step > 0.))
      return;
    const Told reported = trial_.run(offered, 1, offered.step * 50.);
    if (!reported.refused.empty())
      find("guard refuses the step it offers: " + reported.refused, offered, offered.step, 0.);
    let_pass(offered, "guard offers a step that grows");
  }

  void let_pass(const coupling::MethodOptions &options, const std::string &kind)
  {
    const Told reported = forced(options, few_steps);
    if (!grew(reported, growth).value_or(false))
      return;
    const Told longer = forced(options, most_steps);
    find(kind, options, energy_growth(longer), growth);
  }

  const Trial             &trial_;
  double                  &cpu_s_;
  coupling::MethodOptions  options_;
  coupling::LinearSpectrum spectrum_;
  std::vector<Finding>     findings_;
};

} // namespace

std::vector<Finding> guard_findings(const RandomMachine &machine, const Trial &trial, double &cpu_s)
{
  return GuardTrial(machine, trial, cpu_s).findings();
}

} // namespace gestell::tests
