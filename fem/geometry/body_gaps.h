#pragma once

#include "fem/geometry/cad_model.h"

#include <string>
#include <vector>

namespace gestell::fem
{

/// The points where two bodies of a model are closest.
struct BodyGap
{
  int         solid_a = 0, solid_b = 0; ///< indices
  double      distance = 0.;            ///< [m]
  Vector3     at{};                     ///< centre of the gap [m]
  std::string face_a, face_b;           ///< descriptions as used by selectors
};

/**
 * The gap from every body, except the first, to the nearest other one: the gaps of a spanning tree, so that closing
 * them makes the model one body.  Distances between faces are exact (OpenCASCADE); pairs of faces are preselected by
 * their boxes.
 *
 * @param body  of each solid
 */
std::vector<BodyGap> nearest_gaps(const CadModel &model, const std::vector<int> &body);

} // namespace gestell::fem
