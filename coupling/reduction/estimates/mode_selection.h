#pragma once

#include "coupling/frame/reduction_options.h"
#include "coupling/reduction/estimates/damper_attachment_modes.h"
#include "coupling/reduction/estimates/interface_receptance.h"
#include "coupling/reduction/estimates/refined_modes.h"
#include "coupling/reduction/shapes/fixed_interface_modes.h"
#include "coupling/reduction/shapes/interface_statics.h"

#include <string>
#include <vector>

namespace gestell::coupling
{

/// Highest frequency of interest [rad/s]: options.frequency, or that of the twelfth elastic mode of the supported
/// frame.
double highest_of_interest(const ReductionOptions &options, const RefinedModes &refined);

/// "reduction: 23 fixed-interface modes keep the receptance of the interface up to 80 Hz within 0.8 % ...", the worst
/// single interface, and the number of modes of the book's rule (up to 3.5 times the highest frequency).
/// @param dampers  internal dampers of the frame, if any, with known effect.
std::string receptance_statement(const InterfaceReceptance &receptance, const ReductionBasis &basis,
                                 const std::vector<fem::Interface> &interfaces, const InsideCount &inside,
                                 double frequency_hz, const DamperAttachmentModes *dampers = nullptr);

/// Result of select_modes().
struct ModeSelection
{
  RefinedModes             refined;     // on which the choice is based
  Eigen::MatrixXd          shapes{};    // [n x k] to be appended to the modes, if any
  std::string              statement{}; // error of the receptance, if it was the criterion
  std::vector<std::string> notes{};     // errors that remain
};

/**
 * Reduces the basis to the smallest sufficient number m of modes.
 *
 * With options.frequency: the receptance of the interface up to this frequency is within options.tolerance of that of
 * the full frame (InterfaceReceptance), with modes alone, or with fewer modes and the shapes X = C22^-1 (M Psi)_2 if
 * these are fewer in total; static shapes of internal dampers are added (damper_attachment_modes()).  Without a
 * frequency or an interface: the twelve lowest elastic frequencies of the supported frame are within the tolerance,
 * with modes.
 *
 * The basis grows by half of its modes at a time until its estimate is within the tolerance and its highest
 * fixed-interface mode is 1.5 times above the limit, so that no mode is missing and the remainder has a tight bound.
 * The smallest m is then chosen among these modes.  Growth stops at 200 modes, for frequencies at the rule of the book
 * (modes up to 3.5 times the highest); a note then gives the error.
 *
 * @param basis    contains its constraint modes.
 * @param statics  its factor is released at the end.
 */
ModeSelection select_modes(ReductionBasis &basis, FixedInterfaceModes &fixed, const InterfaceStatics &statics,
                           const fem::FrameMatrices &frame, const ReductionOptions &options);

} // namespace gestell::coupling
