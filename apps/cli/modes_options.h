#pragma once

#include <string>
#include <vector>

namespace gestell::apps
{

/// `gestell modes`: about one position, or along a coordinate.
struct ModesCommandOptions
{
  std::string              along;                ///< coordinate; empty: one position
  std::string              from, to;             ///< "100 deg", plain numbers in SI; empty: one turn of an angle
  int                      positions     = 73;   ///< both ends included
  std::string              geometric     = "on"; ///< "on" or "off"
  std::string              configuration = "equilibrium"; ///< or "undeformed"
  std::vector<std::string> hold;                          ///< coordinates at rest in the linearised machine
  std::string              speed;                         ///< of the excitation; empty: that of the scene's start
  int                      orders          = 10;          ///< multiples of it that are looked at
  std::string              band            = "5 %";       ///< how near an order comes to count
  double                   converge        = 0.;    ///< relative error the mesh may leave; 0: the scene's mesh as it is
  int                      frequencies     = 4;     ///< lowest elastic ones of the frame that `converge` watches
  std::string              watch           = "all"; ///< or "frequencies": compliances of interfaces are left out
  int                      max_coordinates = 1000000; ///< of the finest mesh
};

} // namespace gestell::apps
