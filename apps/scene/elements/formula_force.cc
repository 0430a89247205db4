#include "mechanism/elements/formula_force.h"
#include "mechanism/user_force.h"

#include "apps/scene/elements/element_types.h"
#include "apps/scene/read/checked.h"
#include "apps/scene/read/relative_motion.h"

namespace gestell::apps
{

/// +F acts on `from` along the direction, on `to` against it.
void read_formula_force(const SceneTable &table, const Names &names, Scene &scene)
{
  using mechanism::FormulaForce, mechanism::UserForce;
  const auto motion = read_relative_motion(table, names);
  const bool turns  = motion.rotation;
  if (const auto user = table.user_value("force"))
  {
    if (!user->law)
      throw table.error("force", "is a function for a signal; define a force law by Scene.element(NAME, force=...)");
    const auto along = turns ? UserForce::Along::angle : UserForce::Along::line;
    add_element_on(scene, table, checked(table, [&] { return std::make_shared<UserForce>(*user->law, along); }),
                   motion);
    return;
  }
  const Counts                counts    = turns ? Counts::radians : Counts::nothing;
  const std::vector<Variable> variables = {
      // in the order of FormulaForce::Variable
      {"t", "time", kind::time.dimension},
      {"u", turns ? "angle" : "displacement", (turns ? kind::angle : kind::length).dimension, counts},
      {"v", "its rate", (turns ? kind::angular_speed : kind::speed).dimension, counts}};

  FormulaForce::Parameters force;
  force.force = table.formula("force", variables, turns ? kind::torque : kind::force);
  force.along = turns ? FormulaForce::Along::angle : FormulaForce::Along::line;
  add_law<FormulaForce>(scene, table, force, motion);
}

ElementType formula_force_type()
{
  return {"formula force",
          "Force as a formula of time t, displacement or angle u, and its rate v. Events are named after the functions "
          "with kinks: `abs_1_rises`, `if_2_falls`.",
          "`force`, `displacement`, `rate`; for an angle `torque`, `angle`, `rate`",
          joined({motion_keys(),
                  {key::formula("force", kind::force,
                                "formula in t, u and v; a positive force acts on `from` along the direction")
                       .on_angle(kind::torque)}}),
          read_formula_force,
          {R"toml(from  = "slide"
force = "-200 N/mm*u - 5 N*tanh(v/(1 mm/s))"
)toml"}};
}

} // namespace gestell::apps
