#include "coupling/simulation/checks/stability_guard.h"

#include "coupling/integration/integration_methods.h"
#include "coupling/integration/stability/stability.h"
#include "coupling/integration/system/dense_solvers.h"
#include "coupling/simulation/checks/step_roots.h"
#include "fem/values/two_pi.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

namespace gestell::coupling
{

namespace
{

constexpr double harmless = 1e-10; ///< growth per step that 1e9 steps may have

// --- one mode

TestOscillator oscillator(const ModeAccuracy &mode, double omega_h, const MethodOptions &options)
{
  const Spring spring = method_of(options).carries_base() ? Spring::contact : Spring::base;
  return {std::max(0., mode.mode.zeta), omega_h, spring};
}

bool grows(const ModeAccuracy &mode, double omega_h, const MethodOptions &options)
{
  return step_properties(options, oscillator(mode, omega_h, options)).log_growth > harmless;
}

/// omega h of the mode that grows fastest among those between `above` [rad/s] and the bound.
double worst_below(double above, const SpectrumLine &bound, const MethodOptions &options)
{
  const double h = options.step, last = bound.omega * h;
  double       worst = last, most = step_properties(options, {bound.zeta, last}).log_growth;
  for (const UnstableInterval &interval : unstable_intervals(options, bound.zeta))
  {
    const double omega_h = std::clamp(interval.at_omega_h, std::min(above * h, last), last);
    const double growth  = step_properties(options, {bound.zeta, omega_h}).log_growth;
    if (growth > most)
    {
      most  = growth;
      worst = omega_h;
    }
  }
  return worst;
}

/// @param contact_omega  under exact propagation, what elements contribute to omega
ModeAccuracy accuracy(ModeOrigin origin, int number, const SpectrumLine &line, double contact_omega,
                      const MethodOptions &options)
{
  const double h = options.step;
  ModeAccuracy result{origin, number, line, line.omega * h, 1., 0., 0., false};

  double share = 1.; // of the motion that the method approximates
  if (method_of(options).carries_base())
  {
    share = std::pow(contact_omega / line.omega, 2);
    if (!(share > 1e-12))
    {
      result.omega_h         = origin == ModeOrigin::base ? line.omega * h : contact_omega * h;
      result.spectral_radius = std::exp(-std::max(0., line.zeta) * line.omega * h);
      return result;
    }
    result.omega_h = contact_omega * h;
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

// --- motions of all modes together, for methods with IntegrationMethod::step_weights()

/// omega^2, negative for unstable motions.
Eigen::VectorXd stiffness_of(const LinearMachine &machine)
{
  return machine.modes.omega.cwiseAbs2() - machine.modes.growth.cwiseAbs2();
}

/// mass E + damping h B + stiffness h^2 diag(omega^2).
Eigen::MatrixXd balance(const LinearMachine &machine, const StepWeights &w, double h)
{
  Eigen::MatrixXd S = (w.damping * h) * machine.B;
  S.diagonal() += (w.stiffness * h * h) * stiffness_of(machine) + Eigen::VectorXd::Constant(S.rows(), w.mass);
  return S;
}

/// Whether no motion x r^k exists because the balance is positive definite.
bool balanced(const LinearMachine &machine, const MethodOptions &options, double h, double r)
{
  const StepWeights w        = *method_of(options).step_weights(options, r);
  constexpr double  rounding = 1e-14; // of step weights, sums of a few terms of order one
  if (machine.B.rows() == 0 || (w.damping > -rounding && w.stiffness > -rounding)) // for any motion
    return true;
  if (std::abs(w.damping) < rounding)
    return w.mass + w.stiffness * h * h * stiffness_of(machine).maxCoeff() > 0.;
  return Eigen::LLT<Eigen::MatrixXd>(balance(machine, w, h)).info() == Eigen::Success;
}

/// The step in z = (r - 1)/(r + 1) is a machine with mass A, damping D and stiffness C whose motions exp(z t) are its
/// roots; A must be positive definite, r = -1 balanced.
std::optional<GrowingMotion> growing_root(const LinearMachine &machine, const BilinearWeights &weights, double h)
{
  const auto [c, d]            = weights;
  const Eigen::VectorXd square = h * h * stiffness_of(machine);
  const Eigen::MatrixXd C      = square.asDiagonal();
  const Eigen::MatrixXd A      = balance(machine, {4., 2. * c, d}, h);
  const Eigen::MatrixXd D      = balance(machine, {0., 2., c}, h);

  const DenseModes             modes = dense_modes(C, A);
  std::optional<GrowingMotion> worst;
  for (const DampedMode &mode : damped_modes(modes, modes.V.transpose() * D * modes.V, {1e-9, 1e-6}))
  {
    const double               zeta = mode.line.zeta;
    const std::complex<double> z =
        mode.line.omega * std::complex<double>(-zeta, std::sqrt(std::max(0., 1. - zeta * zeta)));
    const double log_growth = 0.5 * std::log1p(4. * z.real() / std::norm(1. - z));
    if (log_growth > harmless && (!worst || std::exp(log_growth) > worst->radius))
      worst = {std::exp(log_growth), modes.V.col(mode.nearest)};
  }
  return worst;
}

/// The motion x r^k with the largest real -r > 1; r = -1 is not balanced.
GrowingMotion growing_alternation(const LinearMachine &machine, const MethodOptions &options, double h)
{
  double still = 2., fast = 1.; // |r| that is balanced, and one that is not
  while (!balanced(machine, options, h, -still) && still < 1e100)
    still = (fast = still) * 2.;
  for (int i = 0; i < 60; ++i)
  {
    const double middle                                     = 0.5 * (still + fast);
    (balanced(machine, options, h, -middle) ? still : fast) = middle;
  }
  const SymmetricEigenSolver solver(balance(machine, *method_of(options).step_weights(options, -fast), h));
  return {fast, solver.eigenvectors().col(0)};
}

bool weighs_steps(const MethodOptions &options)
{
  return method_of(options).step_weights(options, -1.).has_value();
}

std::optional<GrowingMotion> growing_motion(const LinearMachine &machine, const MethodOptions &options, double h)
{
  if (machine.C.size() > 0)
    return growing_step(machine, options, h);
  if (!balanced(machine, options, h, -1.))
    return growing_alternation(machine, options, h);
  if (const auto weights = method_of(options).growing_weights(options))
    return growing_root(machine, *weights, h);
  return {};
}

// --- messages

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

/// "0.3567 < omega h < 1.863", the interval that contains the mode.
std::string interval_text(const ModeAccuracy &mode, const MethodOptions &options)
{
  const TestOscillator o = oscillator(mode, mode.omega_h, options);
  for (const UnstableInterval &interval : unstable_intervals(options, o.zeta, o.spring))
    if (interval.from <= mode.omega_h && mode.omega_h <= interval.to)
      return ", in the unstable interval " +
             (std::isinf(interval.to) ? "omega h > " + number(interval.from, 7)
                                      : number(interval.from, 7) + " < omega h < " + number(interval.to, 7));
  return "; dampers couple it with other modes";
}

std::string growth_text(const ModeAccuracy &mode)
{
  const double excess = mode.spectral_radius - 1.;
  return excess > 1e-4 ? number(mode.spectral_radius, 6) : "1 + " + number(excess, 3);
}

/// Three digits of h, rounded down.
double rounded_down(double h)
{
  const double unit = std::pow(10., std::floor(std::log10(h)) - 2.);
  return unit * std::floor(h / unit);
}

/// Neglected part of the coupling of modes by dampers: for reported accuracy one per cent of the damping ratio; for the
/// decision on growth a ten thousandth, which moves the ends of unstable intervals by less than the three digits of a
/// step.
CouplingTolerance coupling_tolerance(const MethodOptions &options)
{
  const bool judged = !stable_at_every_step(options) && !weighs_steps(options);
  return judged ? CouplingTolerance{1e-6, 1e-4} : CouplingTolerance{1e-4, 1e-2};
}

} // namespace

LinearSpectrum spectrum_for(const Machine &machine, const InitialState &start, const MethodOptions &options)
{
  if (options.tolerance > 0. || !(options.step > 0.) || (is_large(machine) && stable_at_every_step(options)))
    return {};
  return linear_spectrum(machine, start);
}

StabilityGuard::StabilityGuard(const LinearSpectrum &spectrum, const MethodOptions &options)
    : spectrum_(spectrum), options_(options)
{
  if (options.tolerance > 0. || !(options.step > 0.))
    return;
  for (const LinearMachine &machine : spectrum.machines)
    add_machine(machine);
  if (!spectrum.large.empty() && !stable_at_every_step(options))
    add_large();
}

void StabilityGuard::add_machine(const LinearMachine &machine)
{
  const std::size_t first  = modes_.size();
  const auto        damped = machine.C.size() > 0 ? all_damped_modes(machine.modes, machine.C, machine.B)
                                                  : damped_modes(machine.modes, machine.B, coupling_tolerance(options_));
  for (const DampedMode &mode : damped)
    modes_.push_back(
        accuracy(machine.origin, int(mode.nearest) + 1, mode.line, machine.contact_omega[mode.nearest], options_));
  if (!weighs_steps(options_))
    return;
  // The single mode does not decide, because modes are coupled.
  const auto motion = growing_motion(machine, options_, options_.step);
  for (std::size_t i = first; i < modes_.size(); ++i)
  {
    modes_[i].unstable        = modes_[i].unstable && motion;
    modes_[i].spectral_radius = std::min(motion ? motion->radius : 1., modes_[i].spectral_radius);
  }
  if (!motion)
    return;
  Eigen::Index          most;
  const Eigen::VectorXd y = motion->direction.normalized();
  y.cwiseAbs().maxCoeff(&most);
  auto own = std::find_if(modes_.begin() + long(first), modes_.end(),
                          [&](const ModeAccuracy &mode) { return mode.number == int(most) + 1; });
  if (own == modes_.end() || !own->unstable) // the motion's own frequency and damping are those that grow
  {
    const double omega = std::sqrt(y.cwiseAbs2().dot(stiffness_of(machine))), zeta = 0.5 * y.dot(machine.B * y) / omega;
    const ModeAccuracy alone = accuracy(machine.origin, int(most) + 1, {omega, zeta}, 0., options_);
    own                      = own == modes_.end() ? modes_.insert(own, alone) : own;
    *own                     = alone;
  }
  own->unstable        = true;
  own->spectral_radius = motion->radius;
}

void StabilityGuard::add_large()
{
  double above = 0.; // highest frequency that is known
  for (const LargeMode &mode : spectrum_.large)
  {
    // If modes are not integrated separately, dampers may leave any motion undamped.
    SpectrumLine line = weighs_steps(options_) ? SpectrumLine{mode.line.omega, 0.} : mode.line;
    if (mode.bound)
      line.omega = worst_below(above, line, options_) / options_.step;
    modes_.push_back(accuracy(mode.origin, mode.number, line, 0., options_));
    modes_.back().bound = mode.bound;
    above               = std::max(above, line.omega);
  }
}

const ModeAccuracy *StabilityGuard::fastest() const
{
  const ModeAccuracy *worst = nullptr;
  for (const ModeAccuracy &mode : modes_)
    if (mode.unstable && (!worst || mode.spectral_radius > worst->spectral_radius))
      worst = &mode;
  return worst;
}

std::string StabilityGuard::message_of(const ModeAccuracy &worst) const
{
  const auto others = std::count_if(modes_.begin(), modes_.end(), [](const auto &mode) { return mode.unstable; }) - 1;
  const std::string sign = method_of(options_).carries_base() ? "omega_contact h" : "omega h";
  std::string text = method_name(options_) + " is unstable with run.step = " + step_text(options_.step) + ": for " +
                     describe(worst) + " " + sign + " is " + number(worst.omega_h, 5) + interval_text(worst, options_) +
                     ", and its amplitude grows by a factor of " + growth_text(worst) + " in every step";
  if (others > 0)
    text += " (" + std::to_string(others) + (others == 1 ? " more mode grows" : " more modes grow") + ")";
  return text;
}

/// Whether the motion grows; for methods that couple modes.
bool StabilityGuard::motion_grows(double h) const
{
  const auto weights = method_of(options_).growing_weights(options_);
  for (const LinearMachine &machine : spectrum_.machines)
    if (machine.C.size() > 0 ? growing_step(machine, options_, h).has_value()
                             : !balanced(machine, options_, h, -1.) || (weights && growing_root(machine, *weights, h)))
      return true;
  return spectrum_.machines.empty() && mode_grows(h);
}

bool StabilityGuard::mode_grows(double h) const
{
  return std::any_of(modes_.begin(), modes_.end(),
                     [&](const ModeAccuracy &mode)
                     {
                       const bool takes_part = !method_of(options_).carries_base() || mode.period_error != 0.;
                       return takes_part && mode.omega_h > 0. &&
                              grows(mode, mode.omega_h * h / options_.step, options_);
                     });
}

/// Tries slightly shorter steps one after the other, because modes pass through islands of growth.
double StabilityGuard::by_ladder() const
{
  constexpr double ladder = 0.97; // a mode that grows within 3 % of a step only is not met; bisection follows
  double           h      = ladder * options_.step;
  while (h > 1e-3 * options_.step && mode_grows(h))
    h *= ladder;
  double grown = h / ladder;
  for (int i = 0; i < 20; ++i)
    (mode_grows(0.5 * (h + grown)) ? grown : h) = 0.5 * (h + grown);
  return mode_grows(rounded_down(h)) ? 0. : rounded_down(h);
}

/// The interval of stable steps starts at zero: m + b h x^T B x + c h^2 x^T C x with m > 0 has one zero for every x.
double StabilityGuard::by_bisection() const
{
  double h = 1e-3 * options_.step, grown = options_.step;
  if (motion_grows(h))
    return 0.;
  for (int i = 0; i < 25; ++i) // to 1e-7
  {
    const double middle                = std::sqrt(h * grown);
    (motion_grows(middle) ? grown : h) = middle;
  }
  return motion_grows(rounded_down(h)) ? 0. : rounded_down(h);
}

double StabilityGuard::largest_stable_step() const
{
  if (weighs_steps(options_))
    return by_bisection();
  const bool unknown = std::any_of(modes_.begin(), modes_.end(), [](const ModeAccuracy &mode) { return mode.bound; });
  return unknown ? 0. : by_ladder(); // modes that are not known lie anywhere
}

void StabilityGuard::check() const
{
  const ModeAccuracy *worst = fastest();
  if (!worst || method_of(options_).carries_base())
    return;
  const double      step = largest_stable_step();
  const std::string way  = step > 0.
                               ? "use run.step = \"" + step_text(step) +
                                    "\", the largest stable step of this method (accuracy needs a smaller one), or "
                               : "no useful smaller step is known to be stable with this method; use ";
  throw std::invalid_argument(message_of(*worst) + "; " + way +
                              "run.method = \"bdf\" with run.order = 2, stable for every mode at any step; "
                              "run.force_unstable = true runs it anyway");
}

std::vector<std::string> StabilityGuard::warnings() const
{
  if (!method_of(options_).carries_base())
    return {};
  const ModeAccuracy *worst = fastest();
  if (!worst)
    return {};
  const double step = largest_stable_step();
  return {message_of(*worst) + " while its contacts are closed; run.force = \"average\" is stable at every step" +
          (step > 0. ? ", this one with run.step = \"" + step_text(step) + "\" or less" : "")};
}

} // namespace gestell::coupling
