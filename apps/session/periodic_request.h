#pragma once

#include <map>
#include <string>

namespace gestell::apps
{

/// What `gestell periodic` is asked for; texts are as they are typed.
struct PeriodicRequest
{
  std::string method;         ///< empty: chosen by the scene
  std::string period;         ///< "0.2 s"; empty: from drives and loads
  int         ratio     = 1;  ///< of the motion's period to that of the excitation
  double      tolerance = 0.; ///< of closing; 0: as usual

  std::map<std::string, double> own; ///< given options of single methods, by name (PeriodicMethod::options())

  std::string along, from, to; ///< key of the scene that is followed, and its ends
  int         points = 0;      ///< of a branch at most; 0: as usual
  std::string check;           ///< second method
  int         section = 0; ///< periods that the motion is followed to tell what it does in the long run; 0: if need be
  std::string basins;      ///< "X, Y" of the starts whose motions are looked for; empty: none
  int         basin_points = 0; ///< of a side; 0: as usual
};

} // namespace gestell::apps
