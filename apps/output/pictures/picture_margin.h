#pragma once

#include "apps/output/pictures/projection.h"

#include <string>

namespace gestell::apps
{

/// The three axes as SVG about the point (x, y), 24 units long; one that points at the viewer is left out.
std::string axes_triad(const View &view, double x, double y);

/// A bar of a round length, at most `width` units, from (x, y) to the right, with its length above.
std::string scale_bar(const View &view, double x, double y, double width);

/// The largest of 1, 2, 5, 10, 20, ... that is not above x > 0, or below one of 0.5, 0.2, ...
double round_number(double x);

} // namespace gestell::apps
