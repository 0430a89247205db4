#pragma once

#include "apps/output/charts/chart.h"
#include "apps/output/values/periodic_result.h"

#include <vector>

namespace gestell::apps
{

/// Multipliers of the first solutions, and the unit circle.
Chart multiplier_chart(const std::vector<PeriodicEntry> &entries, std::size_t most_solutions);

/// Amplitudes of the drive's harmonics of one solution as bars, each signal against its largest; of many signals the
/// four whose spectra differ most.
Chart harmonics_chart(const PeriodicEntry &entry, std::size_t number);

/// The signals that it leaves out, in a sentence; empty: none.
std::string not_barred(const PeriodicEntry &entry);

/// Solutions in the plane of a signal and its rate; a disc where a period of the excitation begins.
Chart phase_plane_chart(const PhasePlane &plane);

/// The same of a Poincare section: points alone.
Chart section_chart(const PhasePlane &plane, int periods);

/// Cells in the colours of the motions to which they settle; discs: where the stable motions begin a period.
Chart basins_chart(const BasinMap &map);

/// Largest and smallest value of a signal over the parameter; unstable motions dashed.
Chart response_chart(const PeriodicResult &result, std::size_t signal);

/// Amplitude of a signal's first harmonic over the parameter, with the backbone.
Chart amplitude_chart(const PeriodicResult &result, std::size_t signal);

} // namespace gestell::apps
