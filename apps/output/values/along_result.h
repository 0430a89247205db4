#pragma once

#include "apps/output/describe/described.h"
#include "apps/output/values/coupling_descriptions.h"
#include "apps/output/values/line_extremes.h"
#include "coupling/modes/excitation_orders.h"
#include "coupling/modes/modes.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/// Modes along a coordinate, and their excitation there.
struct AlongResult
{
  coupling::ModesAlong                modes;
  coupling::GeometricStiffness        geometric = coupling::GeometricStiffness::included;
  std::string                         fixed;       ///< coordinates locked at rest, for people; may be empty
  double                              speed  = 0.; ///< [rad/s] of the excitation; 0: unknown
  int                                 orders = 10; ///< highest multiple of the speed examined
  double                              band   = 0.05;
  std::vector<coupling::OrderMeeting> meetings;
};

/// A mode tracked over the positions.
struct LineRow
{
  LineExtremes extremes{};
  std::string  moves_most{};
  bool         free = false;
};

template <class Visitor>
void describe(Visitor &v, const LineRow &x)
{
  v("min_hz", x.extremes.min, "Hz", "lowest frequency");
  v("at_min", x.extremes.x_min, "", "coordinate at this frequency");
  v("max_hz", x.extremes.max, "Hz", "highest frequency");
  v("at_max", x.extremes.x_max, "", "coordinate at this frequency");
  v("least_mac", x.extremes.least_assurance, "1", "smallest MAC between neighbouring positions");
  v("moves_most", x.moves_most, "", "dominant coordinate at the first position");
  v("free", x.free, "", "whether the frequency is zero at every position");
}

inline std::vector<LineRow> line_rows(const coupling::ModesAlong &modes)
{
  std::vector<LineRow> rows;
  for (std::size_t i = 0; i < modes.free.size(); ++i)
    rows.push_back({line_extremes(modes, i), modes.moves_most[i], bool(modes.free[i])});
  return rows;
}

template <class Visitor>
void describe(Visitor &v, const AlongResult &x)
{
  v("coordinate", x.modes.coordinate.name, "", "coordinate that is varied");
  v("unit", x.modes.coordinate.unit, "", "of the coordinate");
  v("positions", x.modes.positions.size(), "", "number of positions");
  v("linearisations", x.modes.linearisations, "", "linearisations at positions and between them, for tracking");
  v("geometric", x.geometric == coupling::GeometricStiffness::included, "", "whether geometric stiffness is included");
  v("speed", x.speed, "rad/s", "speed of the excitation; 0: unknown");
  v("lines", line_rows(x.modes), "", "modes followed over the positions");
  v("order_meetings", x.meetings, "", "positions where a frequency is near a multiple of the speed");
}

} // namespace gestell::apps
