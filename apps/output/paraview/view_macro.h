#pragma once

#include <string>

namespace gestell::apps
{

/// Input of the ParaView macro.
struct ViewMacro
{
  double enlargement = 1.; ///< of displacements of the motion
  double time        = 0.; ///< [s] it begins at: the main peak
  double size        = 1.; ///< [m] of the machine
  double speed       = 0.; ///< [m/s] largest at its start, for arrows of a twelfth of the size; 0: none
  double force       = 0.; ///< [N] largest then, for arrows of a sixth of the size; 0: none
};

/// view.py: opens motion.pvd in the same folder in ParaView (5.9 and later), warped, coloured, with arrows of
/// velocities and forces; with pvbatch and the name of a picture it writes this picture.
std::string view_macro(const ViewMacro &view);

} // namespace gestell::apps
