#pragma once

#include "apps/output/values/result.h"

#include <string>

namespace gestell::apps
{

/// "Mode 3: 12.5 Hz" and the damping as text.
std::string mode_heading(std::size_t j, const coupling::Mode &mode);
std::string damping_text(const coupling::Mode &mode);

/**
 * Bar chart of any shape in the machine's coordinates, at most the ten largest.
 *
 * It shows the coordinates that have a physical meaning; the largest one is 1.  Rotations are multiplied by the length
 * angle_arm(), which is printed below the chart, to compare them with displacements.
 */
std::string shape_svg(const Result &result, const std::string &title, const coupling::Mode &mode);

/// Length [m] that converts angles into displacements for display: crank radius, or half the size of the machine.
double angle_arm(const Result &result);

} // namespace gestell::apps
