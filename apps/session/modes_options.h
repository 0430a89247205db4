#pragma once

#include <string>
#include <vector>

namespace gestell::apps
{

/// Modes about one position, or along a coordinate; texts are quantities as they are typed.
struct ModesOptions
{
  std::string              along;                ///< coordinate; empty: one position
  std::string              from, to;             ///< "100 deg", plain numbers in SI; empty: one turn of an angle
  int                      positions     = 73;   ///< both ends included
  std::string              geometric     = "on"; ///< "on" or "off"
  std::string              configuration = "equilibrium"; ///< or "undeformed"
  std::vector<std::string> hold;                          ///< coordinates at rest in the linearised machine
  std::string              speed;                         ///< of the excitation; empty: that of the scene's start
  int                      orders = 10;                   ///< multiples of it that are looked at
  std::string              band   = "5 %";                ///< how near an order comes to count
};

} // namespace gestell::apps
