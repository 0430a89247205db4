#pragma once

#include <map>
#include <string>

namespace gestell::apps
{

/// Options of `gestell periodic`; strings are as typed.
struct PeriodicRequest
{
  std::string method{};       ///< empty: chosen automatically
  std::string period{};       ///< "0.2 s"; empty: from drives and loads
  int         ratio     = 1;  ///< of the motion's period to that of the excitation
  double      tolerance = 0.; ///< of the periodicity residual; 0: default

  std::map<std::string, double> own{}; ///< given options of single methods, by name (PeriodicMethod::options())

  std::string along{}, from{}, to{}; ///< scene key of the continuation, and its limits
  int         points = 0;            ///< largest number per branch; 0: default
  std::string check{};               ///< second method, for verification
  int         section = 0;           ///< periods for the long-term behaviour; 0: only if needed
  std::string basins{};              ///< "X, Y" of the initial states whose basins are computed; empty: none
  int         basin_points = 0;      ///< per side; 0: default
};

} // namespace gestell::apps
