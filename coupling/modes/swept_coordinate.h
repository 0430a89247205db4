#pragma once

#include "coupling/machine/configuration/assembly.h"

namespace gestell::coupling
{

/// A scalar of the configuration along which modes are computed: a coordinate of a body, a measure, or the length of a
/// driven joint.
struct SweptCoordinate
{
  std::string name, unit;           ///< "crank.angle", "rad"
  bool        full_turn  = false;   ///< an angle that returns to the same position
  int         coordinate = -1;      ///< of the machine
  std::string measure{};            ///< NamedMeasure
  int         joint = -1, row = -1; ///< driven joint, as an index of elements(), and its row of g
};

/// "crank" (of a body with one coordinate), "crank.angle", "slide.displacement", "boom.angle", "load.ux", a measure
/// "q4" or "q4.value", a driven joint "cylinder".
/// @throws std::invalid_argument with the nearest name
SweptCoordinate swept_coordinate(const Machine &machine, const std::string &name);

/// Its value at q [m or rad].
double swept_value(const Machine &machine, const SweptCoordinate &coordinate, const Eigen::VectorXd &q);

/// Known values of a position near `state` in which the coordinate has the value x.
KnownStart position_at(Machine &machine, const SweptCoordinate &coordinate, const InitialState &state, double x);

} // namespace gestell::coupling
