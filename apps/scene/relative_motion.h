#pragma once

#include "apps/scene/names.h"
#include "apps/scene/scene.h"

#include <string>

namespace gestell::apps
{

/// a . (motion of `from` - motion of `to`); a motion of the ground is no term.
MotionMeasure difference(const std::string &from, const std::string &to, const Vector3 &axis, bool rotation);

/// Scalar motion between two places, u = motion(from) - motion(to).
struct RelativeMotion
{
  MotionMeasure u;
  bool          rotation = false; ///< u is an angle
  std::string   on;               ///< u is this measure of the scene instead

  std::string           force_unit() const { return rotation ? "N m" : "N"; }
  coupling::MeasureKind kind() const
  {
    return rotation ? coupling::MeasureKind::angle : coupling::MeasureKind::displacement;
  }
};

/**
 * Reads `on`, a measure, or `from`, `to` and `direction` or `about`.  Without either the bodies tell: the axis of the
 * slider, or that of the rotor if the partner is one too or the ground; rotors must share it.
 */
RelativeMotion read_relative_motion(const SceneTable &table, const Names &names);

/// Angle of the rotor `on` against `to`, or else against what carries it: there the stator sits.
MotionMeasure motor_angle(const SceneTable &table, const Names &names, const Scene &scene);

/// Runs `make`, and heads what the element says against its parameters with the place of the table.
template <typename Make>
auto checked(const SceneTable &table, Make make)
{
  try
  {
    return make();
  }
  catch (const std::invalid_argument &e)
  {
    throw table.error(e.what());
  }
}

/// Adds an element of one measure to the scene.
void add_element_on(Scene &scene, const SceneTable &table, std::shared_ptr<mechanism::ForceElement> element,
                    const RelativeMotion &motion);
/// For elements that need a motion along a constant direction. @throws std::invalid_argument if it is a measure
void refuse_measure(const SceneTable &table, const RelativeMotion &motion);
/// Adds an element to the scene.
void add_element(Scene &scene, const SceneTable &table, std::shared_ptr<mechanism::ForceElement> element,
                 const std::vector<MotionMeasure> &measures, const std::vector<LagRequest> &lags = {});

} // namespace gestell::apps
