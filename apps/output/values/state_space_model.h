#pragma once

#include "coupling/periodic/response/state_space.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/// A machine linearised at an operating point, for other programs; all in SI units.
struct StateSpaceModel
{
  std::string              scene, at; ///< "start", "equilibrium", "undeformed"
  double                   t = 0.;    ///< [s] of the operating point
  coupling::StateSpace     system;
  std::vector<std::string> states, coordinates;
  std::vector<std::string> inputs, outputs; ///< "frame.crown.uz [N]", "F_P [N]"
};

} // namespace gestell::apps
