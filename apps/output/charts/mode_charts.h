#pragma once

#include "apps/output/values/result.h"

#include <string>

namespace gestell::apps
{

/// "Mode 3: 12.5 Hz", and its damping in words.
std::string mode_heading(std::size_t j, const coupling::Mode &mode);
std::string damping_text(const coupling::Mode &mode);

/**
 * The bars of any shape in the machine's coordinates, at most the ten largest.
 *
 * They show the coordinates that have a physical meaning, the largest one as 1.  Rotations are compared with
 * displacements by a length, angle_arm(), that stands below.
 */
std::string shape_svg(const Result &result, const std::string &title, const coupling::Mode &mode);

/// Length [m] that scales angles for display beside displacements: crank radius, or half the size of the machine.
double angle_arm(const Result &result);

} // namespace gestell::apps
