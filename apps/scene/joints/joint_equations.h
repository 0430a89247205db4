#pragma once

#include "apps/scene/joints/joined_pair.h"
#include "apps/scene/values/requests.h"
#include "mechanism/joints/ideal_joint.h"

#include <optional>
#include <string>
#include <vector>

namespace gestell::apps
{

/// Rotation of body 2 about a minus `factor` times that of body 1: for rotation about one axis, or small angles.
mechanism::RelativeMeasure rotation_about(const Pair &pair, const mechanism::Vector3d &a, double factor);
/// Angle of body 2 relative to body 1 about a, which is fixed to both, in (-pi, pi]: for free spatial bodies.
mechanism::RelativeMeasure angle_about(const mechanism::Vector3d &a);
/// Displacement of point 2 relative to point 1 along a, which is fixed to body 1.
mechanism::RelativeMeasure seen_from_first(const mechanism::Vector3d &a);

/**
 * The equations of a joint between two points, added one by one.  Equations that no motion of the two bodies changes
 * are omitted; they must be satisfied in the reference configuration.
 *
 * Source: docs/theory/joints.md (3), (10).
 */
class JointEquations
{
public:
  /// @param on_global_axes  the directions are the global axes, as far as the bodies allow, as for compliant joints
  /// @param held_by         body that carries the directions in which two points coincide
  explicit JointEquations(const Pair &pair, bool on_global_axes = false,
                          mechanism::RelativeMeasure::Carrier held_by = mechanism::RelativeMeasure::Carrier::space)
      : pair_(pair), on_global_axes_(on_global_axes), held_by_(held_by)
  {
  }

  std::vector<mechanism::IdealJoint::Equation> list;
  bool                                         holds_point = false; ///< coincide() was called

  const Pair &pair() const { return pair_; }

  /// The two points coincide.
  void coincide();
  /// The second point remains on a line along `axis`, which is fixed to the first body: at its reference position, or
  /// through the first point.
  void on_line(const mechanism::Vector3d &axis, std::optional<double> distance);
  /// The second point remains in the plane normal to `axis` (fixed to the first body) through its reference position.
  void in_plane(const mechanism::Vector3d &axis);
  /// The bodies do not rotate relative to each other.
  void no_rotation();
  /// They rotate relative to each other only about `axis`.
  void one_axis(const mechanism::Vector3d &axis);
  /// a of the first body remains perpendicular to b of the second; they must be so in the reference configuration.
  void at_right_angles(const mechanism::Vector3d &a, const mechanism::Vector3d &b, const std::string &name);
  void distance(const JointRequest &joint);
  /// The coordinate of body 2 is `factor` times that of body 1: angle of a rotor, displacement of a slider ...
  void gear(double factor);

  /// Removes the measures that no equation depends on in any position, such as those normal to the plane of a
  /// mechanism: fewer measures make a step cheaper.
  void leave_out_idle(Pair &pair);

  /// If both bodies move along the same direction, replaces their two measures by the difference: a pin between planar
  /// bodies has four measures, not six.
  void join_translations(Pair &pair);

private:
  using Carrier = mechanism::RelativeMeasure::Carrier;

  std::vector<mechanism::Vector3d>       directions() const;
  std::vector<mechanism::Vector3d>       axes_of_rotation() const;
  bool                                   is_held(const mechanism::RelativeMeasure &distance) const;
  static mechanism::IdealJoint::Equation distance_along(const mechanism::Vector3d &a, Carrier carrier,
                                                        const std::string &name);
  void along(const mechanism::Vector3d &a, Carrier carrier, const std::string &name, std::optional<double> value);
  void ratio(mechanism::IdealJoint::Equation equation, const mechanism::Vector3d &a, double factor);
  void hold_about(const mechanism::Vector3d &axis, const mechanism::Vector3d &across, const std::string &name);
  void require_closed(const mechanism::Vector3d &a, double gap) const; ///< @throws std::invalid_argument
  void add(mechanism::IdealJoint::Equation equation, std::optional<double> value);

  const Pair &pair_;
  bool        on_global_axes_;
  Carrier     held_by_;
};

} // namespace gestell::apps
