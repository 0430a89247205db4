#pragma once

#include "coupling/frame/reduction_options.h"

#include <string>

namespace gestell::coupling
{

/// How a frame is reduced in parts.
struct PartsCall
{
  double      alpha = 0., beta = 0.; ///< of Rayleigh damping of the cells
  std::string place;                 ///< prefix of messages, "press.toml:12: frame"
  int         at_once = 1;           ///< parts side by side
  Progress    progress{};
  std::string prestress{}; ///< place of the loads that the frame is about, or empty
};

} // namespace gestell::coupling
