#pragma once

#include "apps/scene/file/scene_table.h"
#include "apps/scene/read/names.h"
#include "apps/scene/scene.h"
#include "mechanism/joints/motion_law.h"

namespace gestell::apps
{

/// A scalar motion with its unit, "m" or "rad".
struct ScalarRequest
{
  TermRequest term;
  std::string unit;
  std::string name; ///< as the scene calls it

  const Kind &kind() const { return unit == "rad" ? kind::angle : kind::length; }
};

/**
 * Reads a scalar motion by name: a measure, a coordinate "crank.angle", "slide.displacement", "arm.angle", "load.ux", a
 * motion of the frame "frame.foot.ux", or a rotor or slider, whose one coordinate is meant.
 *
 * @throws std::invalid_argument for an unknown name, or for a measure that is a sum itself
 */
ScalarRequest read_scalar(const SceneTable &table, const std::string &key, const Names &names);

/// Refuses an angle of a point, which has no rotation: a torque on it would be lost; and points of bodies, whose angle
/// is that of the whole.
void refuse_turning_point(const SceneTable &table, const Names &names, const PlaceRequest &from,
                          const PlaceRequest &to);

/// s = y - f(x) of the keys `from` (x), `to` (y), and `function` or `table`.
MeasureRequest read_position_function(const SceneTable &table, const Names &names, ScalarRequest &x);

/// Refuses a periodic `function` f(x) of an ideal joint that jumps, or whose slope does, with the place.
void refuse_jumps(const SceneTable &table, const mechanism::PositionFunction &f, const Kind &x);

/// f of `function` or `table`, whose argument is called `variable`.
std::shared_ptr<const mechanism::PositionFunction> read_function(const SceneTable &table, const Variable &variable,
                                                                 const Kind &x, const Kind &y);

/// The sum of `terms = [{ of = "pinion", factor = "r" }, ...]`.
MeasureRequest read_sum(const SceneTable &table, const Names &names);

/// A motion over time: `speed`, constant with a `brake` or a profile, or `function` or `table` of the time.
std::shared_ptr<const mechanism::MotionLaw> read_motion(const SceneTable &table, bool turns);

} // namespace gestell::apps
