#pragma once

#include "apps/output/values/along_result.h"
#include "apps/session/prepared_machine.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/// Options of `modes --along`; strings are quantities as typed.
struct ModesOptions
{
  std::string              along;              ///< coordinate
  std::string              from, to;           ///< "100 deg", plain numbers in SI; empty: one revolution of an angle
  int                      positions     = 73; ///< both ends included
  std::string              configuration = "equilibrium"; ///< or "undeformed"
  std::vector<std::string> hold;                          ///< coordinates locked in the linearised machine
  std::string              speed;                         ///< of the excitation; empty: the initial speed in the scene
  int                      orders = 10;                   ///< multiples of the speed that are examined
  std::string              band   = "5 %";                ///< largest reported distance of an order from a frequency

  coupling::GeometricStiffness geometric = coupling::GeometricStiffness::included;
};

/// Modes along a coordinate, and the orders of the excitation that coincide with them.
/// @throws std::invalid_argument for invalid options, with the option, its value and the requirement
AlongResult modes_along_result(const Scene &scene, PreparedMachine &prepared, const ModesOptions &options,
                               const coupling::Progress &progress = {});

/// Warnings: gaps, positions without equilibrium, lines that may have been exchanged by the tracking.
std::vector<std::string> along_warnings(const AlongResult &along);

/// "100 deg", "2.4 m"
std::string position_text(const coupling::SweptCoordinate &coordinate, double x);

} // namespace gestell::apps
