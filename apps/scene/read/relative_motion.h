#pragma once

#include "apps/scene/read/checked.h"
#include "apps/scene/read/names.h"
#include "apps/scene/values/requests.h"

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
  /// or this one without a name, of two places, counted from the position described
  std::shared_ptr<const MeasureRequest> own{};
  bool                                  follows = false; ///< the direction of `own` turns with its second place

  bool                  is_measure() const { return !on.empty() || own; }
  std::string           force_unit() const { return rotation ? "N m" : "N"; }
  coupling::MeasureKind kind() const
  {
    return rotation ? coupling::MeasureKind::angle : coupling::MeasureKind::displacement;
  }
};

/// Refuses an angle of a point, which has no rotation: a torque on it would be lost; and points of bodies, whose angle
/// is that of the whole.
void refuse_turning_point(const SceneTable &table, const Names &names, const PlaceRequest &from,
                          const PlaceRequest &to);

/**
 * Reads `on`, a measure, or `from`, `to` and `direction` or `about`.  Without either the bodies tell: the axis of the
 * slider, or that of the rotor if the partner is one too or the ground; rotors must share it.  `from` and `to` may be
 * places, or points `at_from`, `at_to` of bodies: then u is the displacement of these points, however bodies turn.
 */
RelativeMotion read_relative_motion(const SceneTable &table, const Names &names);
/// The same of laws that act along a displacement alone.
RelativeMotion read_displacement(const SceneTable &table, const Names &names);

/// Keys that read_relative_motion() asks for; read_load_motion(); read_shaft().
std::vector<Key> motion_keys();
std::vector<Key> load_motion_keys();
std::vector<Key> shaft_keys();

/// As above; of a load, whose direction may turn with `from`: `carried_by`.
RelativeMotion read_load_motion(const SceneTable &table, const Names &names);

/**
 * The angle by which a motor turns its shaft.  `on` is a rotor or a planar body; it turns against `to`, where the
 * stator sits: by default what carries the rotor, or the ground.  Or `on` is a measure that is an angle.
 */
RelativeMotion read_shaft(const SceneTable &table, const Names &names);

/// Adds an element of one measure to the scene, with the virtual coordinates that follow it.
void add_element_on(Scene &scene, const SceneTable &table, std::shared_ptr<mechanism::ForceLaw> element,
                    const RelativeMotion &motion, const std::vector<LagRequest> &lags = {});
/// Makes the law and adds it so; what it has against its parameters is headed by the table's place.
template <typename Law, typename Parameters>
void add_law(Scene &scene, const SceneTable &table, const Parameters &parameters, const RelativeMotion &motion,
             const std::vector<LagRequest> &lags = {})
{
  add_element_on(scene, table, checked(table, [&] { return std::make_shared<Law>(parameters); }), motion, lags);
}

/// Reads an element that is one law of one motion, and whose keys fill its parameters.
template <typename Law, RelativeMotion (*read_motion)(const SceneTable &, const Names &) = read_relative_motion>
void read_law(const SceneTable &table, const Names &names, Scene &scene)
{
  const RelativeMotion motion = read_motion(table, names);
  add_law<Law>(scene, table, table.filled<typename Law::Parameters>(motion.rotation), motion);
}

/// The same motion without a measure, where that is one along or about constant directions; else as it is.
RelativeMotion constant_motion(const RelativeMotion &motion, const Names &names);
/// For elements that need a motion along a constant direction. @throws std::invalid_argument if it is a measure
void refuse_measure(const SceneTable &table, const RelativeMotion &motion);
/// Adds an element to the scene.
void add_element(Scene &scene, const SceneTable &table, std::shared_ptr<mechanism::ForceLaw> element,
                 const std::vector<MotionMeasure> &measures, const std::vector<LagRequest> &lags = {});

} // namespace gestell::apps
