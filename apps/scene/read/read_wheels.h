#pragma once

#include "apps/scene/read/names.h"
#include "apps/scene/values/requests.h"
#include "mechanism/elements/common_tangents.h"

#include <string>

namespace gestell::apps
{

/// Two wheels that turn about parallel axes in one plane.
struct WheelPair
{
  PlaceRequest from, to;      ///< their centres
  Vector3      axis{};        ///< unit vector
  double       distance = 0.; ///< of the centres in the initial configuration [m]
};

/// `from`, `to`, `at_from`, `at_to`, `axis`.
std::vector<Key> wheel_keys(const std::string &wheel);

/// These keys in an example.
std::string wheel_example();

/// @param wheel  for messages, "pulley"
/// @throws the table's error for wheels that do not turn about `axis`, or whose centres lie in different planes
WheelPair read_wheels(const SceneTable &table, const Names &names, const std::string &wheel);

/// Adds a law on the common tangents of the wheels.
void add_on_tangents(Scene &scene, const SceneTable &table, std::shared_ptr<mechanism::ForceLaw> law,
                     const WheelPair &wheels, TangentsRequest tangents);

} // namespace gestell::apps
