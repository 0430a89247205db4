#pragma once

#include <Eigen/Core>

#include <array>
#include <string>
#include <vector>

namespace gestell::apps
{

/// A triangle ready to be drawn.
struct Facet
{
  std::array<Eigen::Vector3d, 3> corners;   ///< as View gives them
  std::string                    colour;    ///< #rrggbb
  int                            face = -1; ///< written as `data-f` of its path; -1: none

  double depth() const { return corners[0][2] + corners[1][2] + corners[2][2]; }
};

/// Of two facets one that is hidden and one that hides it, at so many points of a raster.
struct Hiding
{
  int behind, front, count;
};
using HidingCounts = std::vector<Hiding>;

} // namespace gestell::apps
