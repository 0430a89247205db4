#pragma once

#include "apps/scene/joints/joint_equations.h"
#include "apps/scene/read/names.h"

namespace gestell::apps
{

/// Motion that a joint leaves free and that its surfaces rub along.
struct RubbingMotion
{
  mechanism::RelativeMeasure motion;
  bool                       turns; ///< with the radius of the surface
};

/// Of joints with the key `friction`.
struct FrictionForm
{
  bool turns  = false; ///< needs the radius
  bool guided = false; ///< may have a length
  bool sticks = false; ///< of one motion, along which dry friction may hold
  std::vector<RubbingMotion> (*motions)(const JointRequest &joint, const Pair &pair) = nullptr;
};

/// What a type of joints is; its reader, equations, help, schema and reference come from it.
struct JointType
{
  std::string      name;    ///< value of the key `type`
  std::string      does;    ///< one sentence
  std::string      signals; ///< that it has, in Markdown
  std::vector<Key> keys;    ///< `type` among them; compliance_keys() and joint_friction_key() if it yields and rubs

  void (*read)(const SceneTable &table, const Names &names, JointRequest &joint);
  /// Its equations; null if it is one on a scalar of the motion, JointRequest::measure.
  void (*demand)(JointEquations &equations, const JointRequest &joint) = nullptr;

  FrictionForm friction{};
  bool         holds_rotations = false;
  bool         is_coupling     = false; ///< of the coordinates of two bodies, wherever they are
  int          leaves = 0; ///< directions in which the place may lie anywhere: along its axis, or both across it

  enum class Drawn
  {
    places,
    pin,
    bar
  } drawn = Drawn::places;
};

} // namespace gestell::apps
