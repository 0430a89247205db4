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
  std::string face_a, face_b;           ///< described as selectors find them
};

/**
 * For every body but the first of each connected group the nearest other one: the gaps of a spanning tree, so that
 * closing them makes the model one body.  Exact distances between faces (OpenCASCADE), whose pairs are sorted out by
 * their boxes.
 *
 * @param body  of each solid
 */
std::vector<BodyGap> nearest_gaps(const CadModel &model, const std::vector<int> &body);

} // namespace gestell::fem
