#include "coupling/simulation/energy_guard.h"
#include "coupling/integration/system/state_archive.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

namespace gestell::coupling
{

void EnergyGuard::step(const EnergyState &state, double size)
{
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  if (!std::isfinite(state.input + state.stored + state.dissipated + state.kinetic + state.forces + size))
    throw ConvergenceFailure("the motion diverged: its energy is not finite");
  ++steps_;
  input_.add(state.input);
  dissipated_.add(state.dissipated);
  largest_  = std::max({largest_, state.kinetic, std::abs(state.stored)});
  rounding_ = std::max(rounding_, epsilon * state.forces * std::max(size, 1.));
  loss_     = std::max(loss_, state.residual());
  gain_     = std::max(gain_, -state.residual());
}

double EnergyGuard::exchanged() const
{
  return std::max(largest_, input_.length() + dissipated_.length());
}

double EnergyGuard::residual() const
{
  return std::max(gain_, loss_);
}

EnergyGuard::Verdict EnergyGuard::verdict() const
{
  constexpr double of_begin = 1e-6; // error of iterations, relative to the energy at the start
  const double     E = exchanged(), negligible = std::max(double(steps_) * rounding_, of_begin * std::abs(at_begin_));
  constexpr double little = 0.01, nowhere = 0.5; // shares of E: a relevant error; a spurious energy gain
  if (residual() <= std::max(little * E, negligible))
    return Verdict::closed;
  // a loss above the energy of the motion is spurious; E is known to 50 %
  constexpr double all = 1.5;
  return gain_ > std::max(nowhere * E, negligible) || loss_ > std::max(all * E, negligible) ? Verdict::no_motion
                                                                                            : Verdict::open;
}

std::string EnergyGuard::words(const std::string &method) const
{
  const Verdict verdict = this->verdict();
  if (verdict == Verdict::closed)
    return "";
  std::ostringstream text;
  text << std::setprecision(3) << "energy balance error " << residual() << " J, ";
  if (exchanged() > 0.)
    text << 100. * residual() / exchanged() << " % of the " << exchanged() << " J exchanged by the motion, ";
  text << (gain_ > loss_ ? "a spurious energy gain: " : "numerical dissipation: ") << method;
  text << (verdict == Verdict::open ? " is too coarse for this motion" : "; the result is not physical");
  return text.str();
}

void EnergyGuard::exchange(StateArchive &archive)
{
  archive(at_begin_, gain_, loss_, largest_, rounding_, input_, dissipated_, steps_);
}

} // namespace gestell::coupling
