#pragma once

#include "apps/output/values/result.h"

#include <string>

namespace gestell::apps
{

/**
 * Picture of the frame mode j (from 0): the deformed skin, or for a frame without one its coordinates as bars.
 *
 * Bars show the coordinates that have a physical meaning, the largest one as 1.  Rotations are compared with
 * displacements by a length, the radius of the first crank or else 1 m, that stands below.
 */
std::string frame_mode_svg(const Result &result, std::size_t j);

/// The coordinates of coupled mode j (from 0) as bars: interfaces of the frame and bodies, at most the ten largest.
std::string coupled_mode_svg(const Result &result, std::size_t j);

/// Frame and mechanism in coupled mode j (from 0), deformed, as drawn of that scenery; empty if nothing is to be seen.
std::string coupled_mode_picture(const Result &result, const Scenery &scenery, std::size_t j);

/// The bars of any shape in the machine's coordinates.
std::string shape_svg(const Result &result, const std::string &title, const coupling::Mode &mode);

/// Length [m] that scales angles for display beside displacements: crank radius, or half the size of the machine.
double angle_arm(const Result &result);

} // namespace gestell::apps
