#pragma once

#include "apps/scene/file/scene_table.h"
#include "mechanism/elements/clearance.h"
#include "mechanism/sliding_friction.h"

namespace gestell::apps
{

/// Stiffness, exponent and dissipation, which every contact has; the dissipation also by `restitution` at an
/// `impact_speed`.
/// @param turns  it acts on an angle
mechanism::Clearance::Parameters read_contact(const SceneTable &table, bool turns);

/// Keys that read_contact() asks for.
std::vector<Key> contact_keys();

/// The key that read_sliding_friction() asks for.
Key sliding_friction_key();

/// `friction`: a coefficient, or a table `{ coefficient, speed, static, stribeck_speed, stribeck_exponent }`; without
/// it there is none.
mechanism::SlidingFriction read_sliding_friction(const SceneTable &table);

} // namespace gestell::apps
