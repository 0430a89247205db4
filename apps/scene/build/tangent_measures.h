#pragma once

#include "apps/scene/joints/joined_pair.h"
#include "apps/scene/values/requests.h"
#include "mechanism/measures/relative_measure.h"

#include <array>
#include <vector>

namespace gestell::apps
{

/// Distance of the centres of two wheels [m] in the plane across `axis`, a unit vector.
/// @throws std::invalid_argument if they have one axis
double centre_distance(const mechanism::Placement &first, const mechanism::Placement &second,
                       const mechanism::Vector3d &axis);

/// Common tangent of two wheels that turn about `axis`:  r_1 phi_1 + r_2 phi_2 - (r_1 + r_2) psi + f [h(D) - h(D_0)],
/// see RelativeMeasure.
/// @param radii  r_1, r_2 [m], signed
/// @param form   `gear` or `strand`
mechanism::RelativeMeasure tangent_of(const mechanism::Placement &first, const mechanism::Placement &second,
                                      const mechanism::Vector3d &axis, const std::array<double, 2> &radii, double f,
                                      mechanism::RelativeMeasure::Form form);

/// The measures of mechanism::CommonTangents.
std::vector<mechanism::RelativeMeasure> tangent_measures(const TangentsRequest &request, const Pair &pair);

/// The same place, its point on the axis of the rotor that it lies on, if it lies on one.
/// @throws std::invalid_argument if the point is too far beside that axis
PlaceRequest on_own_axis(const coupling::MachineModel &machine, const PlaceRequest &place, double distance);

} // namespace gestell::apps
