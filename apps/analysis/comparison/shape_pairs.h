#pragma once

#include "apps/analysis/comparison/mode_comparison.h"

#include <string>

namespace gestell::apps
{

/**
 * Shapes of matched modes side by side, a panel for each pair: at every measure a bar of the first machine and below it
 * one of the other, each shape with its largest amplitude at 1.  Angles are drawn times `arm` [m].
 * @return empty where there is no pair
 */
std::string shape_pairs_svg(const ComparedShapes &shapes, double arm);

} // namespace gestell::apps
