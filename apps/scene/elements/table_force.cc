#include "mechanism/elements/table_force.h"

#include "apps/scene/read/checked.h"
#include "apps/scene/read/relative_motion.h"

namespace gestell::apps
{

/// +F acts on `from` along the direction, on `to` against it.
void read_table_force(const SceneTable &table, const Names &names, Scene &scene)
{
  using Against             = mechanism::TableForce::Against;
  const auto        motion  = read_relative_motion(table, names);
  const bool        turns   = motion.rotation;
  const std::string against = table.choice("against", {"time", "displacement", "rate"}, "");
  const Kind       &x       = against == "time"           ? kind::time
                              : against == "displacement" ? (turns ? kind::angle : kind::length)
                                                          : (turns ? kind::angular_speed : kind::speed);

  mechanism::TableForce::Parameters force;
  force.against = against == "time" ? Against::time : against == "displacement" ? Against::displacement : Against::rate;
  for (const auto &row : table.pairs("table", x, turns ? kind::torque : kind::force))
    force.rows.push_back({row[0], row[1]});
  add_element_on(scene, table, checked(table, [&] { return std::make_shared<mechanism::TableForce>(force); }), motion);
}

} // namespace gestell::apps
