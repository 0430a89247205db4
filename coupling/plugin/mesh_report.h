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
  double                density = 0.;           ///< of the mass [kg/m^3]
  std::string           material{};             ///< of a STEP file
};

/// Faces that are selected together.
struct FaceGroup
{
  std::string      name;     ///< "this bore"
  std::vector<int> faces;    ///< their tags
  std::string      selector; ///< keys of [frame.surface.NAME]
};

struct SurfaceReport
{
  int                    tag;
  std::string            name;     ///< names and groups from the file, then those of the specification
  std::string            type;     ///< "plane, normal (0 0 1), through (0 0 0.9)"
  std::string            selector; ///< keys of [frame.surface.NAME] that select it
  double                 area;     ///< [m^2]
  std::array<double, 3>  min, max, centre;
  std::vector<int>       found_with{}; ///< tags of other faces that no selector distinguishes from it
  std::string            kind{};       ///< "plane", "cylinder", else the type in gmsh
  std::array<double, 3>  direction{};  ///< outward normal of a plane, axis of a cylinder
  std::array<double, 3>  through{};    ///< [m] a point of the plane, of the axis
  double                 radius = 0.;  ///< [m] of a cylinder
  std::vector<FaceGroup> groups{};     ///< larger surfaces that the face of a cylinder belongs to, the smallest first
};

/// The skin of a mesh: triangles and their faces.
struct FacePicture
{
  std::vector<std::array<double, 3>> points;    ///< [m]
  std::vector<std::array<int, 3>>    triangles; ///< into points, outside counter-clockwise
  std::vector<int>                   face;      ///< index into MeshReport::surfaces of each triangle
};

/// The length unit of a file.
struct LengthUnit
{
  double      length = 1.;  ///< [m]
  std::string name   = "m"; ///< "mm", "inch", or "0.03 m" if it has no name
};

/// What `gestell mesh` reports of a file: geometry, mesh, and cost of the frame.
struct MeshReport
{
  int                        n_points = 0, n_cells = 0, n_coordinates = 0;
  std::string                cells;                  ///< "tetrahedra", or "cells (12 tetrahedra, 8 prisms)"
  double                     size   = 0.;            ///< of the elements [m]; 0 for a mesh file
  double                     volume = 0., mass = 0.; ///< [m^3], [kg]
  double                     worst_quality = 0., mean_quality = 0.;
  double                     expected_cells = 0.;                ///< estimate before meshing; 0 for a mesh file
  double                     memory = 0., available_memory = 0.; ///< of the reduction, of this machine [byte]
  std::vector<std::string>   features;                           ///< smallest edges and faces, thin walls
  std::vector<std::string>   notes, statements;
  std::vector<SolidReport>   solids;
  std::vector<SurfaceReport> surfaces;
  FacePicture                picture;
  LengthUnit                 unit;
};

} // namespace gestell::coupling
