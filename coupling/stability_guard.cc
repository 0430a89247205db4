#include "coupling/stability_guard.h"

#include "coupling/integration/stability.h"
#include "fem/two_pi.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace gestell::coupling
{

namespace
{

constexpr double harmless = 1e-10; // growth per step that 1e9 steps may have
TestOscillator   oscillator(const ModeAccuracy &mode, double omega_h, const MethodOptions &options)
{
  const bool contact = options.method == Method::exact && mode.origin == ModeOrigin::closed;
  return {std::max(0., mode.mode.zeta), omega_h, contact ? Spring::contact : Spring::base};
}

bool grows(const ModeAccuracy &mode, double omega_h, const MethodOptions &options)
{
  return step_properties(options, oscillator(mode, omega_h, options)).log_growth > harmless;
}

/// omega h of the mode that grows fastest among those between `above` [rad/s] and the bound.
double worst_below(double above, const LinearMode &bound, const MethodOptions &options)
{
  const double h = options.step, last = bound.line.omega * h;
  double       worst = last, most = step_properties(options, {bound.line.zeta, last}).log_growth;
  for (const UnstableInterval &interval : unstable_intervals(options, bound.line.zeta))
  {
    const double omega_h = std::clamp(interval.at_omega_h, std::min(above * h, last), last);
    const double growth  = step_properties(options, {bound.line.zeta, omega_h}).log_growth;
    if (growth > most)
    {
      most  = growth;
      worst = omega_h;
    }
  }
  return worst;
}

ModeAccuracy accuracy(const LinearMode &mode, double omega, const MethodOptions &options)
{
  const double h = options.step;
  ModeAccuracy result{mode.origin, mode.number, {omega, mode.line.zeta}, omega * h, 1., 0., 0., false, mode.bound};

  double share = 1.; // of the motion that the method approximates
  if (options.method == Method::exact)
  {
    share          = std::pow(mode.contact_omega / omega, 2);
    result.omega_h = mode.contact_omega * h;
    if (mode.origin == ModeOrigin::base || !(share > 1e-12))
    {
      const double zeta      = std::max(0., mode.line.zeta);
      result.omega_h         = mode.origin == ModeOrigin::base ? omega * h : result.omega_h;
      result.spectral_radius = std::exp(-zeta * omega * h);
      return result;
    }
  }
  const StepProperties step = step_properties(options, oscillator(result, result.omega_h, options));
  result.spectral_radius    = step.spectral_radius;
  result.numerical_damping  = share * step.numerical_damping;
  result.period_error       = share * step.period_elongation;
  result.unstable           = step.log_growth > harmless;
  return result;
}

bool stable_at_every_step(const MethodOptions &options)
{
  return unstable_intervals(options, 0.).empty();
}

const ModeAccuracy *fastest(const std::vector<ModeAccuracy> &modes)
{
  const ModeAccuracy *worst = nullptr;
  for (const ModeAccuracy &mode : modes)
    if (mode.unstable && (!worst || mode.spectral_radius > worst->spectral_radius))
      worst = &mode;
  return worst;
}

std::string number(double x, int digits)
{
  std::ostringstream text;
  text.precision(digits);
  text << x;
  return text.str();
}

std::string step_text(double h)
{
  return h < 1e-3 ? number(1e6 * h, 4) + " us" : h < 1. ? number(1e3 * h, 4) + " ms" : number(h, 4) + " s";
}

std::string describe(const ModeAccuracy &mode)
{
  const std::string what =
      "(" + number(mode.mode.omega / two_pi, 5) + " Hz, damping ratio " + number(std::max(0., mode.mode.zeta), 3) + ")";
  if (mode.bound)
    return "a mode of the frame, up to number " + std::to_string(mode.number) + " " + what;
  return "mode " + std::to_string(mode.number) +
         (mode.origin == ModeOrigin::base ? " of the frame " : " of the machine with closed contacts ") + what;
}

/// "0.3567 < omega h < 1.863", the interval in which the mode lies.
std::string interval_text(const ModeAccuracy &mode, const MethodOptions &options)
{
  const TestOscillator o = oscillator(mode, mode.omega_h, options);
  for (const UnstableInterval &interval : unstable_intervals(options, o.zeta, o.spring))
    if (interval.from <= mode.omega_h && mode.omega_h <= interval.to)
      return std::isinf(interval.to) ? "omega h > " + number(interval.from, 7)
                                     : number(interval.from, 7) + " < omega h < " + number(interval.to, 7);
  return "omega h = " + number(mode.omega_h, 7);
}

std::string growth_text(const ModeAccuracy &mode)
{
  const double excess = mode.spectral_radius - 1.;
  return excess > 1e-4 ? number(mode.spectral_radius, 6) : "1 + " + number(excess, 3);
}

std::string message_of(const std::vector<ModeAccuracy> &modes, const ModeAccuracy &worst, const MethodOptions &options)
{
  const auto others = std::count_if(modes.begin(), modes.end(), [](const auto &mode) { return mode.unstable; }) - 1;
  const std::string sign = options.method == Method::exact ? "omega_contact h" : "omega h";
  std::string       text = method_name(options) + " is unstable with run.step = " + step_text(options.step) + ": for " +
                     describe(worst) + " " + sign + " is " + number(worst.omega_h, 5) + ", in the unstable interval " +
                     interval_text(worst, options) + ", and its amplitude grows by the factor " + growth_text(worst) +
                     " in every step";
  if (others > 0)
    text += " (" + std::to_string(others) + (others == 1 ? " more mode grows" : " more modes grow") + ")";
  return text;
}

} // namespace

std::vector<ModeAccuracy> mode_accuracy(const Machine &machine, const InitialState &initial,
                                        const MethodOptions &options)
{
  Eigen::MatrixXd M, B, C;
  const bool      large = machine.full_frame() || !machine.dense_matrices(M, B, C);
  if (options.tolerance > 0. || !(options.step > 0.) || (large && stable_at_every_step(options)))
    return {};
  const bool                complex = options.method == Method::bdf && options.order > 2;
  const auto                rule    = complex ? DampingRule::exact : DampingRule::diagonal;
  double                    above   = 0.; // highest frequency that is known
  std::vector<ModeAccuracy> result;
  for (const LinearMode &mode : linear_modes(machine, initial.q, rule))
  {
    const double omega = mode.bound ? worst_below(above, mode, options) / options.step : mode.line.omega;
    result.push_back(accuracy(mode, omega, options));
    above = std::max(above, mode.line.omega);
  }
  return result;
}

double largest_stable_step(const std::vector<ModeAccuracy> &modes, const MethodOptions &options)
{
  if (options.method == Method::bdf &&
      std::any_of(modes.begin(), modes.end(), [](const ModeAccuracy &mode) { return mode.bound; }))
    return 0.;                        // modes that are not known lie anywhere
  const ModeAccuracy *last = nullptr; // the one that grew, asked first at the next step
  const auto          bad  = [&](double factor)
  {
    const auto grows_now = [&](const ModeAccuracy &mode)
    {
      return (options.method != Method::exact || mode.origin == ModeOrigin::closed) && mode.omega_h > 0. &&
             grows(mode, mode.omega_h * factor, options);
    };
    if (last && grows_now(*last))
      return true;
    for (const ModeAccuracy &mode : modes)
      if (grows_now(mode))
      {
        last = &mode;
        return true;
      }
    return false;
  };

  constexpr double ladder = 0.97;
  double           factor = ladder;
  while (factor > 1e-3 && bad(factor))
    factor *= ladder;
  if (factor <= 1e-3)
    return 0.;
  double grown = factor / ladder;
  for (int i = 0; i < 20; ++i)
    (bad(0.5 * (factor + grown)) ? grown : factor) = 0.5 * (factor + grown);
  const double unit = std::pow(10., std::floor(std::log10(factor * options.step)) - 2.);
  const double step = unit * std::floor(factor * options.step / unit);
  return bad(step / options.step) ? 0. : step;
}

void check_stability(const std::vector<ModeAccuracy> &modes, const MethodOptions &options)
{
  const ModeAccuracy *worst = fastest(modes);
  if (!worst || options.method == Method::exact)
    return;
  const double      step = largest_stable_step(modes, options);
  const std::string way =
      step > 0. ? "take run.step = \"" + step_text(step) +
                      "\", the largest one below that is stable with this method (accuracy wants less), or "
                : "no smaller step that would be of use is known to be stable with this method; take ";
  throw std::invalid_argument(message_of(modes, *worst, options) + "; " + way +
                              "run.method = \"bdf\" with run.order = 2, stable for every mode at any step; "
                              "run.force_unstable = true runs it as it is");
}

std::vector<std::string> stability_warnings(const std::vector<ModeAccuracy> &modes, const MethodOptions &options)
{
  if (options.method != Method::exact || options.force == ForceRule::average)
    return {};
  const ModeAccuracy *worst = fastest(modes);
  if (!worst)
    return {};
  const double step = largest_stable_step(modes, options);
  return {message_of(modes, *worst, options) +
          " as long as its contacts stay closed; run.force = \"average\" is stable at every step" +
          (step > 0. ? ", this one with run.step = \"" + step_text(step) + "\" or less" : "")};
}

} // namespace gestell::coupling
