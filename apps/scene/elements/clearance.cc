#include "mechanism/elements/clearance.h"

#include "apps/scene/relative_motion.h"

namespace gestell::apps
{

void read_clearance(const SceneTable &table, const Names &names, Scene &scene)
{
  // Hunt and Crossley's factor is a reciprocal speed: s/m, or s/rad between rotors.
  static const Kind dissipation{"dissipation factor", "0.3 s/m", {-1, 0, 1}};
  static const Kind torsional_dissipation{"dissipation factor", "0.3 s/rad", {0, 0, 1}};

  const auto                       motion = read_relative_motion(table, names);
  const bool                       turns  = motion.rotation;
  mechanism::Clearance::Parameters play;
  play.gap         = table.not_negative("gap", turns ? kind::angle : kind::length);
  play.stiffness   = table.positive("stiffness", turns ? kind::torsional_stiffness : kind::stiffness);
  play.dissipation = table.not_negative("dissipation", turns ? torsional_dissipation : dissipation, play.dissipation);
  add_element(scene, table, checked(table, [&] { return std::make_shared<mechanism::Clearance>(play); }), {motion.u});
}

} // namespace gestell::apps
