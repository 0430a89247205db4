#include "mechanism/elements/table_force.h"

#include "apps/scene/elements/element_types.h"
#include "apps/scene/read/relative_motion.h"

namespace gestell::apps
{

/// +F acts on `from` along the direction, on `to` against it.
void read_table_force(const SceneTable &table, const Names &names, Scene &scene)
{
  using Against             = mechanism::TableForce::Against;
  const auto        motion  = read_relative_motion(table, names);
  const bool        turns   = motion.rotation;
  const std::string against = table.choice("against");
  const Kind       &x       = against == "time"           ? kind::time
                              : against == "displacement" ? (turns ? kind::angle : kind::length)
                                                          : (turns ? kind::angular_speed : kind::speed);

  mechanism::TableForce::Parameters force;
  force.against = against == "time" ? Against::time : against == "displacement" ? Against::displacement : Against::rate;
  for (const auto &row : table.pairs("table", x, turns ? kind::torque : kind::force))
    force.rows.push_back({row[0], row[1]});
  add_law<mechanism::TableForce>(scene, table, force, motion);
}

ElementType table_force_type()
{
  return {
      "table force",
      "Force from a table, linear between the rows and constant beyond them; two rows with the same argument are a "
      "jump.",
      "`force`, `displacement`, `rate`",
      joined({motion_keys(),
              {key::choice("against", {"time", "displacement", "rate"}, false, "quantity in the first column"),
               key::composed("table", Key::Form::rows, kind::force, {},
                             "two rows or more in ascending order; a positive force acts on `from` along the direction")
                   .on_angle(kind::torque)}}),
      read_table_force,
      {R"toml(from    = "slide"
against = "time"
table   = [["0 s", "3 kN"], ["0.2 s", "3 kN"], ["0.2 s", 0]]
)toml"}};
}

} // namespace gestell::apps
