#pragma once

#include "apps/scene/file/scene_table.h"
#include "mechanism/elements/clearance.h"
#include "mechanism/sliding_friction.h"

namespace gestell::apps
{

/// Reads stiffness, exponent and dissipation of a contact; the dissipation is also computed from `restitution` at an
/// `impact_speed`.
/// @param turns  it acts on an angle
mechanism::Clearance::Parameters read_contact(const SceneTable &table, bool turns);

/// Keys of read_contact().
std::vector<Key> contact_keys();

/// The key of read_sliding_friction().
Key sliding_friction_key();

/// `friction`: a coefficient, or a table `{ coefficient, speed, static, stribeck_speed, stribeck_exponent }`; without
/// it there is none.
mechanism::SlidingFriction read_sliding_friction(const SceneTable &table);

} // namespace gestell::apps
