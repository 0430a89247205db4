#pragma once

#include "coupling/modes/mode_tracking.h"
#include "coupling/modes/swept_coordinate.h"

#include <functional>

namespace gestell::coupling
{

enum class Configuration
{
  equilibrium, ///< held_equilibrium(): at rest under weights and springs
  undeformed   ///< joints and chains closed, without deflection
};

struct AlongOptions
{
  double        from = 0., to = 0.; ///< of the coordinate, both inclusive
  int           positions     = 0;  ///< equidistant, >= 2
  Configuration configuration = Configuration::equilibrium;
  Linearisation linearisation; ///< multipliers and damping are set by the function
  int           lines = 20;    ///< number of modes tracked, the lowest at `from`
};

/// The machine at one position.
struct ModesAt
{
  double              x = 0.;
  std::string         gap; ///< not empty: reason why there are no modes here
  Configuration       configuration = Configuration::equilibrium;
  std::string         no_equilibrium; ///< reason why it is undeformed although an equilibrium was requested
  std::vector<Mode>   modes;          ///< by line
  std::vector<double> assurance;      ///< by line, (v^T M v_before)^2; nan at the first position
};

struct ModesAlong
{
  SweptCoordinate          coordinate;
  std::vector<ModesAt>     positions;
  std::vector<std::string> moves_most;         ///< by line: the coordinate with most of the kinetic energy at its start
  std::vector<bool>        free;               ///< by line: without a frequency at all positions
  int                      linearisations = 0; ///< at positions, and in between for tracking
};

/**
 * Natural frequencies and shapes of the machine linearised at positions of a coordinate: quasi natural frequencies.
 *
 * The coordinate is fixed only while the position is computed; in the linearised machine it moves, as joints allow,
 * unless it is in linearisation.fixed.  Each position is computed from the previous one, so that a linkage remains on
 * its branch; the distance from `start` to options.from is covered in steps no longer than those between positions.
 *
 * Source: Dresig, Vul'fson, Dynamik der Mechanismen, section 5.5; docs/theory/modes_along.md.
 *
 * @param start     assembled, on the desired branch
 * @param progress  called with the completed share
 * @throws std::invalid_argument for fewer than two positions, an empty range, or if no position can be computed
 */
ModesAlong modes_along(Machine &machine, const SweptCoordinate &coordinate, const InitialState &start,
                       const AlongOptions &options, const std::function<void(double)> &progress = {});

} // namespace gestell::coupling
