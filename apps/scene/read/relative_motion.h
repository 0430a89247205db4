#pragma once

#include "apps/scene/read/checked.h"
#include "apps/scene/read/names.h"
#include "apps/scene/values/requests.h"

#include <string>

namespace gestell::apps
{

/// a . (motion of `from` - motion of `to`); the ground contributes no term.
MotionMeasure difference(const std::string &from, const std::string &to, const Vector3 &axis, bool rotation);

/// Scalar motion between two points, u = motion(from) - motion(to).
struct RelativeMotion
{
  MotionMeasure u;
  bool          rotation = false; ///< u is an angle
  std::string   on;               ///< u is this measure of the scene instead
  /// or this measure without a name, of two points, relative to the reference configuration
  std::shared_ptr<const MeasureRequest> own{};
  bool                                  follows = false; ///< the direction of `own` rotates with its second point

  bool                  is_measure() const { return !on.empty() || own; }
  std::string           force_unit() const { return rotation ? "N m" : "N"; }
  coupling::MeasureKind kind() const
  {
    return rotation ? coupling::MeasureKind::angle : coupling::MeasureKind::displacement;
  }
};

/// Rejects an angle of a point mass, which has no rotation, so that a torque on it would be lost; also of points of
/// bodies, because the angle is that of the body.
void refuse_turning_point(const SceneTable &table, const Names &names, const PlaceRequest &from,
                          const PlaceRequest &to);

/**
 * Reads `on`, a measure, or `from`, `to` and `direction` or `about`.  Without direction the bodies determine it: the
 * axis of the slider, or that of the rotor if the other body is also a rotor or the ground; rotors must have the same
 * axis.  `from` and `to` may be markers, or points `at_from`, `at_to` of bodies: then u is the displacement of these
 * points, also for large rotations.
 */
RelativeMotion read_relative_motion(const SceneTable &table, const Names &names);
/// The same for laws that act only along a displacement.
RelativeMotion read_displacement(const SceneTable &table, const Names &names);

/// Keys of read_relative_motion(); read_load_motion(); read_shaft().
std::vector<Key> motion_keys();
std::vector<Key> load_motion_keys();
std::vector<Key> shaft_keys();

/// The same for a load, whose direction may rotate with `from`: `carried_by`.
RelativeMotion read_load_motion(const SceneTable &table, const Names &names);

/**
 * Reads the angle through which a motor drives its shaft.  `on` is a rotor or a planar body; the angle is relative to
 * `to`, the body with the stator: by default the carrier of the rotor, or the ground.  Or `on` is an angle measure.
 */
RelativeMotion read_shaft(const SceneTable &table, const Names &names);

/// Adds an element of one measure to the scene, with the virtual coordinates that belong to it.
void add_element_on(Scene &scene, const SceneTable &table, std::shared_ptr<mechanism::ForceLaw> element,
                    const RelativeMotion &motion, const std::vector<LagRequest> &lags = {});
/// Makes the law and adds it in the same way; errors about parameters contain the location of the table.
template <typename Law, typename Parameters>
void add_law(Scene &scene, const SceneTable &table, const Parameters &parameters, const RelativeMotion &motion,
             const std::vector<LagRequest> &lags = {})
{
  add_element_on(scene, table, checked(table, [&] { return std::make_shared<Law>(parameters); }), motion, lags);
}

/// Reads an element that consists of one law of one motion; keys fill its parameters.
template <typename Law, RelativeMotion (*read_motion)(const SceneTable &, const Names &) = read_relative_motion>
void read_law(const SceneTable &table, const Names &names, Scene &scene)
{
  const RelativeMotion motion = read_motion(table, names);
  add_law<Law>(scene, table, table.filled<typename Law::Parameters>(motion.rotation), motion);
}

/// The same motion without a measure, if it is along or about constant directions; else unchanged.
RelativeMotion constant_motion(const RelativeMotion &motion, const Names &names);
/// For elements that need a constant direction. @throws std::invalid_argument if the motion is a measure
void refuse_measure(const SceneTable &table, const RelativeMotion &motion);
/// Adds an element to the scene.
void add_element(Scene &scene, const SceneTable &table, std::shared_ptr<mechanism::ForceLaw> element,
                 const std::vector<MotionMeasure> &measures, const std::vector<LagRequest> &lags = {});

} // namespace gestell::apps
