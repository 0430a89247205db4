#pragma once

#include <Eigen/Core>

#include <array>
#include <vector>

namespace gestell::apps
{

/// A surface of triangles with a displacement at each point.
struct Skin
{
  std::vector<Eigen::Vector3d>    points;       ///< [m]
  std::vector<Eigen::Vector3d>    displacement; ///< [m], as many as points
  std::vector<std::array<int, 3>> triangles;    ///< outside counter-clockwise

  /// Length [m] of the diagonal of the box around the points.
  double size() const;
  /// Largest displacement [m].
  double largest_displacement() const;
};

/// A subset of the points of a skin, and triangles between them.
struct CoarseMesh
{
  std::vector<int>                points;    ///< of the skin
  std::vector<std::array<int, 3>> triangles; ///< into this choice
  std::vector<int>                source;    ///< index of the skin's triangle that each triangle came from
};

/// Coarsens a skin: points in one cell of a cubic grid (edge length `edge`) whose faces lie in the same planes are
/// merged into the point nearest to their mean, and degenerate triangles are removed.  Planes remain plane, straight
/// edges straight, and corners in place.
CoarseMesh coarse_mesh(const Skin &skin, double edge);

/// Edges (pairs of points) where adjacent triangles meet at more than `degrees`, or that have one triangle only.
std::vector<std::array<int, 2>> sharp_edges(const Skin &skin, double degrees = 35.);

} // namespace gestell::apps
