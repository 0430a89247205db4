#pragma once

#include "coupling/integration/method_options.h"
#include "coupling/integration/stability/test_oscillator.h"

namespace gestell::coupling
{

/// Largest |x| / x_0 or, for an initial velocity, |x| omega / v_0; the largest |x'| / omega is scaled in the same way.
struct Overshoot
{
  double displacement, velocity;
  int    displacement_step, velocity_step; ///< where they occur
};

enum class OscillatorStart
{
  displaced, ///< x = 1, x' = 0
  moving     ///< x = 0, x' = omega
};

/// Overshoot in the first 20 steps, from consistent accelerations.
Overshoot overshoot(const MethodOptions &options, const TestOscillator &oscillator, OscillatorStart start,
                    FirstSteps first_steps = FirstSteps::as_integrated);

} // namespace gestell::coupling
