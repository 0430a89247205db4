#pragma once

#include "apps/scene/joints/joint_equations.h"
#include "apps/scene/read/names.h"

namespace gestell::apps
{

/// A free motion of a joint with friction between its surfaces.
struct RubbingMotion
{
  mechanism::RelativeMeasure motion;
  bool                       turns; ///< rotation, with the radius of the surface
};

/// Friction of joints with the key `friction`.
struct FrictionForm
{
  bool turns  = false; ///< needs the radius
  bool guided = false; ///< may have a length
  bool sticks = false; ///< of a single motion, in which dry friction can stick
  std::vector<RubbingMotion> (*motions)(const JointRequest &joint, const Pair &pair) = nullptr;
};

/// A type of joints; its reader, equations, help, schema and reference are generated from this.
struct JointType
{
  std::string      name;    ///< value of the key `type`
  std::string      does;    ///< description in one sentence
  std::string      signals; ///< of the type, in Markdown
  std::vector<Key> keys;    ///< including `type`; compliance_keys() and joint_friction_key() if it supports them

  void (*read)(const SceneTable &table, const Names &names, JointRequest &joint);
  /// Adds its equations; null if the joint is one equation on a scalar, JointRequest::measure.
  void (*demand)(JointEquations &equations, const JointRequest &joint) = nullptr;

  FrictionForm friction{};
  bool         holds_rotations = false;
  bool         is_coupling     = false; ///< of the coordinates of two bodies at any position
  int          leaves = 0; ///< directions in which the point may be anywhere: along its axis, or both normal to it

  enum class Drawn
  {
    places,
    pin,
    bar
  } drawn = Drawn::places;
};

} // namespace gestell::apps
