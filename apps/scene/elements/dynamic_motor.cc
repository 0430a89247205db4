#include "mechanism/elements/dynamic_motor.h"

#include "apps/scene/read/checked.h"
#include "apps/scene/read/relative_motion.h"

#include <cmath>

namespace gestell::apps
{

/// Of asynchronous motors, stationary or dynamic.
mechanism::KlossMotor::Parameters read_kloss(const SceneTable &table);

/// Measures: angle of the shaft, against the stator; the torque, a lag.
void read_dynamic_motor(const SceneTable &table, const Names &names, Scene &scene)
{
  const auto shaft = read_shaft(table, names);
  const auto motor = read_kloss(table);
  if (table.has("time_constant") == table.has("mains_frequency"))
    throw table.error(
        "needs either 'time_constant', with which the torque follows, or 'mains_frequency', from which it "
        "is computed");
  const double lag = table.has("time_constant")
                         ? table.positive("time_constant", kind::time)
                         : 1. / (2. * M_PI * table.positive("mains_frequency", kind::frequency) * motor.breakdown_slip);
  add_element_on(scene, table, checked(table, [&] { return std::make_shared<mechanism::DynamicMotor>(motor); }), shaft,
                 {{table.name() + ".torque", lag}});
}

} // namespace gestell::apps
