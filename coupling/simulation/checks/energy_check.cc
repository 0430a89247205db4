#include "coupling/simulation/checks/energy_check.h"

#include "coupling/integration/integration_methods.h"
#include "coupling/integration/system/convergence_failure.h"
#include "coupling/integration/system/state_archive.h"

#include <sstream>

namespace gestell::coupling
{

namespace
{

constexpr const char *energy_finding = "energy-balance";

std::string method_and_step(const MethodOptions &method)
{
  std::ostringstream text;
  text << method_name(method) << " with a ";
  if (method.tolerance > 0.)
    text << "tolerance of " << method.tolerance;
  else
    text << "step of " << method.step << " s";
  return text.str();
}

/// Remedy for a method that conserves energy badly.
std::string remedy(const MethodOptions &method, EnergyGuard::Verdict verdict)
{
  if (method.tolerance > 0.)
    return "; use a smaller tolerance";
  if (verdict == EnergyGuard::Verdict::no_motion)
    return "; use a smaller step, or method = \"bdf\" with a tolerance, which finds its steps itself";
  const std::string advice = method_of(method).energy_advice(method);
  return "; use a smaller step" + (advice.empty() ? "" : ". " + advice);
}

/// The balance must not err more than the integrator.
PowerRule power_rule(const MethodOptions &method, const Sampling &sampling)
{
  // For a sine four points integrate the square with an error of 1e-5 over half a period.
  constexpr double samples = 8.;
  return {method_of(method).takes_long_steps(method), samples * sampling.shortest};
}

} // namespace

EnergyCheck::EnergyCheck(const Machine &machine, const TimeIntegrator &integrator, const RunOptions &options,
                         const Sampling &sampling)
    : machine_(machine), integrator_(integrator), method_(options.method), forced_(options.force_unstable),
      energy_(machine), rule_(power_rule(options.method, sampling))
{
}

void EnergyCheck::begin()
{
  energy_.begin(integrator_.instant());
  guard_    = EnergyGuard(energy_.at_begin());
  rounding_ = {};
  summary_  = {};
}

void EnergyCheck::step()
{
  if (!(integrator_.time() > integrator_.step_begin()))
    return;
  energy_.step(integrator_, rule_, guard_.exchanged());
  const Instant    &now    = integrator_.instant();
  const EnergyState energy = energy_.state(now);
  guard_.step(energy, now.q.size() > 0 ? now.q.cwiseAbs().maxCoeff() : 0.);
  rounding_.step(now.q);
  summary_ = {energy.input, energy.stored, energy.dissipated, guard_.residual(), guard_.exchanged()};
}

EnergySummary EnergyCheck::inside(const Instant &instant)
{
  const EnergyState energy = energy_.state(integrator_, instant);
  return {energy.input, energy.stored, energy.dissipated};
}

std::string EnergyCheck::words(EnergyGuard::Verdict verdict) const
{
  return guard_.words(method_and_step(method_)) + remedy(method_, verdict);
}

void EnergyCheck::verify() const
{
  if (guard_.verdict() == EnergyGuard::Verdict::no_motion && !forced_)
    throw ConvergenceFailure(words(EnergyGuard::Verdict::no_motion), energy_finding);
}

void EnergyCheck::finish(RunOutcome &outcome)
{
  rounding_.finish(machine_.linear(), guard_.exchanged(), energy_.at_begin(), outcome);
  const EnergyGuard::Verdict verdict = guard_.verdict();
  if (verdict == EnergyGuard::Verdict::closed)
    return;
  const std::string words = this->words(verdict);
  if (outcome.failure.empty() && verdict == EnergyGuard::Verdict::no_motion && !forced_)
    outcome.stop(energy_finding, "", words);
  else if (outcome.end_id != energy_finding) // verify() may have ended the run with it
    outcome.warn(energy_finding, "", words);
}

void EnergyCheck::exchange(StateArchive &archive)
{
  archive(energy_, guard_, rounding_, summary_);
}

} // namespace gestell::coupling
