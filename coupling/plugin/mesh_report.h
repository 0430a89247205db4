#pragma once

#include <array>
#include <string>
#include <vector>

namespace gestell::coupling
{

struct SolidReport
{
  std::string           name;
  double                volume = 0., mass = 0.; ///< [m^3], [kg]
  std::array<double, 3> min{}, max{};           ///< [m]
};

struct SurfaceReport
{
  int                   tag;
  std::string           name;     ///< names and groups it has in the file, then those of the specification
  std::string           type;     ///< "plane, normal (0 0 1), through (0 0 0.9)"
  std::string           selector; ///< that finds it, as an entry of [frame.surface.NAME]
  double                area;     ///< [m^2]
  std::array<double, 3> min, max, centre;
};

/// What `gestell mesh` tells of a file, its mesh, and what the frame would cost.
struct MeshReport
{
  int                        n_points = 0, n_cells = 0, n_coordinates = 0;
  std::string                cells;                  ///< "tetrahedra", or "cells (12 tetrahedra, 8 prisms)"
  double                     size   = 0.;            ///< of the elements [m]; 0 for a mesh file
  double                     volume = 0., mass = 0.; ///< [m^3], [kg]
  double                     worst_quality = 0., mean_quality = 0.;
  double                     expected_cells = 0.;                ///< judged before meshing; 0 for a mesh file
  double                     memory = 0., available_memory = 0.; ///< of the reduction, of this machine [byte]
  std::vector<std::string>   features;                           ///< smallest edges and faces, thin walls
  std::vector<std::string>   notes, statements;
  std::vector<SolidReport>   solids;
  std::vector<SurfaceReport> surfaces;
};

} // namespace gestell::coupling
