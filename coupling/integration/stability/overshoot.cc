#include "coupling/integration/stability/overshoot.h"

#include "coupling/integration/integration_methods.h"

#include <cmath>

namespace gestell::coupling
{

Overshoot overshoot(const MethodOptions &options, const TestOscillator &o, OscillatorStart start,
                    FirstSteps first_steps)
{
  constexpr int         n_steps = 20; // the first swing, after which damping has acted
  const double          Omega   = o.omega_h;
  const bool            moving  = start == OscillatorStart::moving;
  const Eigen::Vector2d begin(moving ? 0. : 1., moving ? Omega : 0.);
  Overshoot             largest{begin[0], begin[1] / Omega, 0, 0};
  int                   step = 0;
  for (const Eigen::Vector2d &state : method_of(options).first_steps(options, o, begin, n_steps, first_steps))
  {
    ++step;
    if (std::abs(state[0]) > largest.displacement)
      largest.displacement = std::abs(state[0]), largest.displacement_step = step;
    if (std::abs(state[1]) / Omega > largest.velocity)
      largest.velocity = std::abs(state[1]) / Omega, largest.velocity_step = step;
  }
  return largest;
}

} // namespace gestell::coupling
