#pragma once

#include "apps/output/charts/chart.h"
#include "apps/output/values/periodic_result.h"

#include <vector>

namespace gestell::apps
{

/// Multipliers of the first solutions, and the unit circle.
Chart multiplier_chart(const std::vector<PeriodicEntry> &entries, std::size_t most_solutions);

/// Bar chart of the amplitudes of the drive's harmonics of one solution, each signal relative to its largest; of many
/// signals the four whose spectra differ most.
Chart harmonics_chart(const PeriodicEntry &entry, std::size_t number);

/// The signals that harmonics_chart() omits, in a sentence; empty: none.
std::string not_barred(const PeriodicEntry &entry);

/// Solutions in the plane of a signal and its rate; discs mark the start of each excitation period.
Chart phase_plane_chart(const PhasePlane &plane);

/// The same for a Poincare section: points only.
Chart section_chart(const PhasePlane &plane, int periods);

/// Basins of attraction: each cell has the colour of the solution it settles to; discs mark stable solutions.
Chart basins_chart(const BasinMap &map);

/// Largest and smallest value of a signal over the parameter; unstable motions dashed.
Chart response_chart(const PeriodicResult &result, std::size_t signal);

/// Amplitude of a signal's first harmonic over the parameter, with the backbone.
Chart amplitude_chart(const PeriodicResult &result, std::size_t signal);

} // namespace gestell::apps
