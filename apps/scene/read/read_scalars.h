#pragma once

#include "apps/scene/file/scene_table.h"
#include "apps/scene/read/names.h"
#include "apps/scene/values/requests.h"

namespace gestell::apps
{

/// A scalar motion with its unit, "m" or "rad".
struct ScalarRequest
{
  TermRequest term;
  std::string unit;
  std::string name; ///< its name in the scene

  const Kind &kind() const { return unit == "rad" ? kind::angle : kind::length; }
};

/**
 * Reads a scalar motion by name: a measure, a coordinate "crank.angle", "slide.displacement", "arm.angle", "load.ux", a
 * DOF of the frame "frame.foot.ux", or a rotor or slider, which means its only coordinate.
 *
 * @throws std::invalid_argument for an unknown name, or for a measure that is a sum itself
 */
ScalarRequest read_scalar(const SceneTable &table, const std::string &key, const Names &names);

/// Reads s = y - f(x) from the keys `from` (x), `to` (y), and `function` or `table`.
MeasureRequest read_position_function(const SceneTable &table, const Names &names, ScalarRequest &x);

/// Reads the sum `terms = [{ of = "pinion", factor = "r" }, ...]`.
MeasureRequest read_sum(const SceneTable &table, const Names &names);

} // namespace gestell::apps
