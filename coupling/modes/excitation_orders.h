#pragma once

#include "coupling/modes/modes_along.h"

namespace gestell::coupling
{

/// An interval of the coordinate in which a natural frequency is near a multiple of the speed:  |f / (k f_0) - 1| <=
/// band.
struct OrderMeeting
{
  int    order = 0, line = 0;       ///< k, from 1; line from 0
  double begin = 0., end = 0.;      ///< of the coordinate; equal if the line crosses the order between two positions
  double x = 0., frequency_hz = 0.; ///< where they are closest
  double distance = 0.;             ///< f / (k f_0) - 1 there
};

/// Meetings of all lines with the orders 1 ... n_orders of f_0 [Hz], sorted by order, line and coordinate.  Between
/// positions frequencies are interpolated linearly.
std::vector<OrderMeeting> order_meetings(const ModesAlong &along, double f_0, int n_orders, double band);

} // namespace gestell::coupling
