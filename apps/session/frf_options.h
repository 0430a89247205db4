#pragma once

#include <string>
#include <vector>

namespace gestell::apps
{

/// What frequency responses are asked for; texts are quantities as they are typed.
struct FrfOptions
{
  std::vector<std::string> from, to;            ///< signal paths, signals of the scene, bodies
  std::string              kind = "receptance"; ///< or "mobility", "accelerance"
  std::string              at   = "start";      ///< or "equilibrium", "undeformed"
  std::string              lowest, highest;     ///< "1 Hz"; empty: about the modes of the machine
  int                      points  = 400;       ///< those that peaks ask for are added
  std::string              spacing = "log";     ///< or "linear"
  std::vector<std::string> measured;            ///< files, or NAME=FILE
};

} // namespace gestell::apps
