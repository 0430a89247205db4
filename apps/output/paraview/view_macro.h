#pragma once

#include <string>

namespace gestell::apps
{

/// What the macro opens.
struct ViewMacro
{
  double enlargement = 1.; ///< of displacements of the motion
  double time        = 0.; ///< [s] it begins at: the main peak
  double size        = 1.; ///< [m] of the machine
  double speed       = 0.; ///< [m/s] largest at its begin, for arrows of a twelfth of the size; 0: none
  double force       = 0.; ///< [N] largest then, for arrows of a sixth of the size; 0: none
};

/// view.py: opens motion.pvd beside it in ParaView (5.9 and later), warped, coloured, with arrows of velocities and
/// forces; run
/// by pvbatch with the name of a picture it writes that.
std::string view_macro(const ViewMacro &view);

} // namespace gestell::apps
