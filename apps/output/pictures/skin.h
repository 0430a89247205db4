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

/// A choice of the points of a skin, and triangles between them.
struct CoarseMesh
{
  std::vector<int>                points;    ///< of the skin
  std::vector<std::array<int, 3>> triangles; ///< into this choice
  std::vector<int>                source;    ///< of each triangle, the one of the skin that it came from
};

/// The skin on fewer points: those in one cell of a cubic grid of the given edge length whose faces lie in the same
/// planes are drawn together to the one nearest to their mean, and triangles that become lines vanish.  Planes stay
/// plane, straight edges straight, corners where they are.
CoarseMesh coarse_mesh(const Skin &skin, double edge);

/// Edges (pairs of points) where neighbouring triangles meet at more than `degrees`, or that have one triangle only.
std::vector<std::array<int, 2>> sharp_edges(const Skin &skin, double degrees = 35.);

} // namespace gestell::apps
