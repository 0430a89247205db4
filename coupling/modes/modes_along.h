#pragma once

#include "coupling/modes/mode_tracking.h"
#include "coupling/modes/swept_coordinate.h"

#include <functional>

namespace gestell::coupling
{

enum class Configuration
{
  equilibrium, ///< held_equilibrium(): standing still under weights and springs
  undeformed   ///< joints and chains closed, nothing deflected
};

struct AlongOptions
{
  double        from = 0., to = 0.; ///< of the coordinate, both included
  int           positions     = 0;  ///< equidistant, >= 2
  Configuration configuration = Configuration::equilibrium;
  Linearisation linearisation; ///< multipliers and damping are the function's
  int           lines = 20;    ///< modes followed, the lowest at `from`
};

/// The machine at one position.
struct ModesAt
{
  double              x = 0.;
  std::string         gap; ///< not empty: why there are no modes here
  Configuration       configuration = Configuration::equilibrium;
  std::string         no_equilibrium; ///< why it is undeformed although not asked to be
  std::vector<Mode>   modes;          ///< by line
  std::vector<double> assurance;      ///< by line, (v^T M v_before)^2; nan at a first position
};

struct ModesAlong
{
  SweptCoordinate          coordinate;
  std::vector<ModesAt>     positions;
  std::vector<std::string> moves_most; ///< by line: the coordinate with most of the kinetic energy where it begins
  std::vector<bool>        free;       ///< by line: without a frequency at all positions
  int                      linearisations = 0; ///< positions and what tracking took between them
};

/**
 * Natural frequencies and shapes of the machine linearised at positions of a coordinate: quasi natural frequencies.
 *
 * The coordinate is held only while the position is found; in the linearised machine it moves, as joints let it, unless
 * linearisation.fixed names it.  Each position is found from the one before, so that a linkage stays on its branch; the
 * way from `start` to options.from is gone in steps no longer than those between positions.
 *
 * Source: Dresig, Vul'fson, Dynamik der Mechanismen, section 5.5; docs/theory/modes_along.md.
 *
 * @param start  closed joints, on the wanted branch
 * @param progress  called with the share done
 * @throws std::invalid_argument for less than two positions, an empty range, or if there is no position at all
 */
ModesAlong modes_along(Machine &machine, const SweptCoordinate &coordinate, const InitialState &start,
                       const AlongOptions &options, const std::function<void(double)> &progress = {});

} // namespace gestell::coupling
