#pragma once

#include <functional>
#include <string>

namespace gestell::coupling
{

struct ReductionOptions
{
  int         n_modes   = -1;   ///< retained modes; < 0: chosen for `tolerance`
  double      tolerance = 0.01; ///< relative error of the interface's receptance up to `frequency` (automatic number)
  double      frequency = 0.;   ///< [Hz] highest frequency of interest; 0: that of the twelfth elastic mode
  std::string place;            ///< "press.toml:60: reduction", prefix of messages
  std::string method         = "craig-bampton"; ///< a name of Reductions
  std::string factor;                           ///< see make_factor(); empty: by the number of processes
  std::string eigensolver    = "block-lanczos"; ///< or a type of SLEPc, see search_modes()
  bool        inertia_relief = false; ///< adds the deflections under the inertia of rigid-body motions to the modes
};

/// Called with the name of the phase that begins and the completed share, 0..1 (negative: unknown).
using Progress = std::function<void(const std::string &phase, double share)>;

} // namespace gestell::coupling
