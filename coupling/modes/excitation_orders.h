#pragma once

#include "coupling/modes/modes_along.h"

namespace gestell::coupling
{

/// A stretch of the coordinate on which a natural frequency lies near a multiple of the speed:  |f / (k f_0) - 1| <=
/// band.
struct OrderMeeting
{
  int    order = 0, line = 0;  ///< k, from 1; line from 0
  double begin = 0., end = 0.; ///< of the coordinate; equal where the line only passes through between two positions
  double x = 0., frequency_hz = 0.; ///< where they are nearest
  double distance = 0.;             ///< f / (k f_0) - 1 there
};

/// Meetings of all lines with the orders 1 ... n_orders of f_0 [Hz], in the order of order, line and coordinate.
/// Between positions frequencies are taken as linear.
std::vector<OrderMeeting> order_meetings(const ModesAlong &along, double f_0, int n_orders, double band);

} // namespace gestell::coupling
