#pragma once

#include "coupling/frame_service.h"
#include "coupling/reduction/fixed_modes.h"
#include "coupling/reduction/supported_modes.h"

#include <string>
#include <vector>

namespace gestell::coupling
{

/// Highest frequency of interest [rad/s]: options.frequency, or that of the twelfth elastic mode of the supported
/// frame.
double highest_of_interest(const ReductionOptions &options, const SupportedModes &refined);

/**
 * Brings the basis to the smallest number m of modes for which the frequencies of the supported frame up to
 * options.frequency are within options.tolerance.
 *
 * The basis grows by half of its modes at a time until (a) its frequencies up to the limit differ from the refined ones
 * (SupportedModes) by less than the tolerance, and (b) its highest fixed-interface mode lies 1.5 times above the limit,
 * so that no mode is missing.  The last refined frequencies, better by far, are then the measure for the smallest m.
 * The book's rule, modes up to 3.5 times the highest frequency, is where growth stops at the latest; then, and at 200
 * modes, a note tells what was reached.
 *
 * options.frequency = 0 asks for the twelve lowest elastic modes of the supported frame.
 *
 * @return the refined modes the choice rests on.
 */
SupportedModes enough_modes(ReductionBasis &basis, FixedModes &fixed, const InteriorResponse &response,
                            const fem::FrameMatrices &frame, const ReductionOptions &options, const Progress &progress,
                            std::vector<std::string> &notes);

} // namespace gestell::coupling
