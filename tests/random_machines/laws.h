#pragma once

#include "tests/random_machines/draft.h"

namespace gestell::tests
{

/// The table of an element on the link.  @return its name
std::string begin_element(Draft &draft, const Link &link, const std::string &letter, const std::string &type);
/// That of a motor, which turns the link's shaft.
std::string begin_motor(Draft &draft, const Link &link, const std::string &type);

inline void lossy(Draft &draft)
{
  draft.machine.conservative = false;
}
inline void nonlinear(Draft &draft)
{
  draft.machine.linear = false;
}

// Contacts
void add_stop(Draft &draft, const Link &link);
void add_clearance(Draft &draft, const Link &link);
void add_rope(Draft &draft, const Link &link);
void add_wheel(Draft &draft, const Link &link);

// Friction
void add_dry_friction(Draft &draft, const Link &link);
void add_brake(Draft &draft, const Link &link);
void add_smooth_friction(Draft &draft, const Link &link);
void add_lugre(Draft &draft, const Link &link);

// Loads and springs
void add_force(Draft &draft, const Link &link);
void add_cubic_spring(Draft &draft, const Link &link);
void add_formula(Draft &draft, const Link &link);
void add_table_force(Draft &draft, const Link &link);
void add_profile(Draft &draft, const Link &link);

// Tools and drives
void add_blanking(Draft &draft, const Link &link);
void add_cutting(Draft &draft, const Link &link);
void add_drawing(Draft &draft, const Link &link);
void add_gas(Draft &draft, const Link &link);
void add_motor(Draft &draft, const Link &link);
void add_dynamic_motor(Draft &draft, const Link &link);
void add_speed_drive(Draft &draft, const Link &link);
void add_cylinder(Draft &draft, const Link &link);

} // namespace gestell::tests
