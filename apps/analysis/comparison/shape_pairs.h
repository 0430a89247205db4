#pragma once

#include "apps/analysis/comparison/mode_comparison.h"

#include <string>

namespace gestell::apps
{

/**
 * Shapes of matched modes, a panel for each pair: for every measure a bar of the first machine and below it one of the
 * other, each shape scaled to a largest amplitude of 1.  Angles are multiplied by `arm` [m].
 * @return empty if there is no pair
 */
std::string shape_pairs_svg(const ComparedShapes &shapes, double arm);

} // namespace gestell::apps
