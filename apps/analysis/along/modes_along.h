#pragma once

#include "apps/output/values/along_result.h"
#include "apps/session/prepared_machine.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/// Texts are quantities as they are typed.
struct ModesOptions
{
  std::string              along;              ///< coordinate
  std::string              from, to;           ///< "100 deg", plain numbers in SI; empty: one turn of an angle
  int                      positions     = 73; ///< both ends included
  std::string              configuration = "equilibrium"; ///< or "undeformed"
  std::vector<std::string> hold;                          ///< coordinates at rest in the linearised machine
  std::string              speed;                         ///< of the excitation; empty: that of the scene's start
  int                      orders = 10;                   ///< multiples of it that are examined
  std::string              band   = "5 %";                ///< how near an order comes to count

  coupling::GeometricStiffness geometric = coupling::GeometricStiffness::included;
};

/// Modes along a coordinate, with the orders of excitation that meet them.
/// @throws std::invalid_argument for options that do not fit: which, the value, and what is needed
AlongResult modes_along_result(const Scene &scene, PreparedMachine &prepared, const ModesOptions &options,
                               const coupling::Progress &progress = {});

/// Its findings: gaps, positions without equilibrium, lines that may have been taken for one another.
std::vector<std::string> along_warnings(const AlongResult &along);

/// "100 deg", "2.4 m"
std::string position_text(const coupling::SweptCoordinate &coordinate, double x);

} // namespace gestell::apps
