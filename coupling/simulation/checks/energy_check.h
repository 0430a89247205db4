#pragma once

#include "coupling/integration/events/run_observer.h"
#include "coupling/integration/system/energy_balance.h"
#include "coupling/machine/machine.h"
#include "coupling/simulation/energy_guard.h"
#include "coupling/simulation/rounding_guard.h"
#include "coupling/simulation/run_result.h"
#include "coupling/simulation/signal_extremes.h"

namespace gestell::coupling
{

/// Computes the energy balance of a motion and checks its residual, and forces that are only rounding errors.
class EnergyCheck : public RunObserver
{
public:
  EnergyCheck(const Machine &machine, const TimeIntegrator &integrator, const RunOptions &options,
              const Sampling &sampling);

  void begin() override;
  void step() override;
  void event(const Event &) override { energy_.jump(integrator_.instant()); }
  void verify() const override; ///< throws for a spurious energy gain, or a loss of more than the available energy
  void finish(RunOutcome &outcome) override;
  void exchange(StateArchive &archive) override;

  const EnergySummary &summary() const { return summary_; } ///< at the end of the last step
  /// At an instant inside the last step.
  EnergySummary inside(const Instant &instant);

private:
  std::string words(EnergyGuard::Verdict verdict) const;

  const Machine        &machine_;
  const TimeIntegrator &integrator_;
  MethodOptions         method_;
  bool                  forced_; ///< the run continues although its result is not physical
  EnergyBalance         energy_;
  PowerRule             rule_;
  EnergyGuard           guard_;
  RoundingGuard         rounding_;
  EnergySummary         summary_;
};

} // namespace gestell::coupling
