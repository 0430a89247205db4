#pragma once

#include "fem/values/message_text.h"
#include "fem/values/vector3.h"

#include <string>
#include <vector>

namespace gestell::fem
{

/// Directions with a smaller difference [rad] are equal; normals from CAD have an accuracy of 1e-6.
constexpr double straight = 1e-3;

/// Kind of a face, as selectors distinguish it.
enum class FaceKind
{
  plane,
  cylinder,
  other
};

/// A face of the CAD model (or a surface of a mesh without geometry), all lengths in metres.
struct Face
{
  struct Sample
  {
    Vector3 point;
    Vector3 normal; ///< outward, unit length
  };

  int                      tag  = 0;
  FaceKind                 kind = FaceKind::other;
  std::string              type;   ///< type in gmsh: "Plane", "Cylinder", "BSpline surface", ...
  std::string              name;   ///< label in the STEP file, "" if it has none
  std::vector<std::string> groups; ///< physical groups, layers and colours ("#ff8000") of the face
  std::vector<int>         edges;  ///< tags of its boundary curves: faces with a common one are adjacent
  double                   area = 0.;
  Vector3                  min{}, max{}, centre{};
  Vector3                  direction{};     ///< plane: outward normal; cylinder: axis, first component != 0 positive
  Vector3                  through{};       ///< plane: a point of it; cylinder: of its axis; closest to centre
  double                   radius  = 0.;    ///< cylinder
  bool                     faceted = false; ///< given by triangles only, with approximate normals
  std::vector<Sample>      samples;         ///< points of the underlying surface
};

/**
 * Finds kind, direction, through and radius from the samples alone, so that a plane written as a spline is recognised
 * as a plane. A point is on the surface within the tolerance [m].
 */
void recognise(Face &face, double tolerance);

/// One line of data for a selector: "face 12: plane, normal (0 0 1), through (0 0 0.9), area 0.21 m^2".
std::string describe(const Face &face);

} // namespace gestell::fem
