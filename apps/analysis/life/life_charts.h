#pragma once

#include "apps/analysis/life/life_result.h"
#include "apps/output/charts/chart.h"

#include <string>

namespace gestell::apps
{

/// Share of the colour scale of a damage: its logarithm, 0 up to a ten-thousandth of the largest.
constexpr double shaded_decades = 4.;
double           shade_of(double damage, double most);

/// Stress over time at the worst place, with the turning points of the most damaging cycles.
Chart life_history_chart(const LifeResult &found);

/// Range-mean matrix as SVG, coloured by damage.
std::string range_mean_picture(const LifeResult &found);

/// Amplitude over mean of the cycles, and the amplitude that does no damage.
Chart haigh_chart(const LifeResult &found);

} // namespace gestell::apps
