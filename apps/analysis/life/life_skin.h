#pragma once

#include "apps/analysis/life/damage/stress_measure.h"
#include "coupling/frame/reduced_frame.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace gestell::apps
{

/// The skin of a frame at whose points stresses are known.
struct LifeSkin
{
  std::vector<Eigen::Vector3d>    position;   ///< [points] m
  std::vector<std::array<int, 3>> triangles;  ///< outside counter-clockwise
  std::vector<SurfaceDirections>  directions; ///< [points] normals; none at edges, where they differ
  double                          size = 0.;  ///< [m] diagonal of the box around it

  Eigen::Vector3d normal(const std::array<int, 3> &triangle) const; ///< times twice its area
};

LifeSkin skin_of(const coupling::ReducedFrame &frame);

/// Points away from what makes surfaces rigid (`beside` false), or next to it.
std::vector<char> points_by_rigid(const coupling::ReducedStress &stress, bool beside);

} // namespace gestell::apps
