#pragma once

#include "apps/scene/joints/joined_pair.h"
#include "apps/scene/values/requests.h"
#include "mechanism/joints/ideal_joint.h"

#include <optional>
#include <string>
#include <vector>

namespace gestell::apps
{

/// Rotation of body 2 about a, less `factor` times that of body 1: of bodies that turn about one axis, or little.
mechanism::RelativeMeasure rotation_about(const Pair &pair, const mechanism::Vector3d &a, double factor);
/// Angle of body 2 against body 1 about a, which both carry, in (-pi, pi]: of bodies that turn freely.
mechanism::RelativeMeasure angle_about(const mechanism::Vector3d &a);
/// Displacement of place 2 against place 1 along a, which body 1 carries.
mechanism::RelativeMeasure seen_from_first(const mechanism::Vector3d &a);

/**
 * The equations of a joint between two places, one after the other.  Those that no motion of the two bodies changes are
 * left out; a distance that they would have to close must be closed as described.
 *
 * Source: docs/theory/joints.md (3), (10).
 */
class JointEquations
{
public:
  /// @param on_global_axes  directions are these as far as the bodies let: what yields has a stiffness along each
  /// @param held_by         what carries the directions along which two places stay together
  explicit JointEquations(const Pair &pair, bool on_global_axes = false,
                          mechanism::RelativeMeasure::Carrier held_by = mechanism::RelativeMeasure::Carrier::space)
      : pair_(pair), on_global_axes_(on_global_axes), held_by_(held_by)
  {
  }

  std::vector<mechanism::IdealJoint::Equation> list;
  bool                                         holds_point = false; ///< coincide() is among them

  const Pair &pair() const { return pair_; }

  /// The two places stay together.
  void coincide();
  /// The second place stays on a line along `axis`, which turns with the first body: as described, or through the first
  /// place.
  void on_line(const mechanism::Vector3d &axis, std::optional<double> distance);
  /// The second place stays as described in a plane across `axis`, which turns with the first body.
  void in_plane(const mechanism::Vector3d &axis);
  /// The bodies do not turn against each other.
  void no_rotation();
  /// They turn against each other about `axis` alone.
  void one_axis(const mechanism::Vector3d &axis);
  /// a of the first body stays at right angles to b of the second, to which it is so as described.
  void at_right_angles(const mechanism::Vector3d &a, const mechanism::Vector3d &b, const std::string &name);
  void distance(const JointRequest &joint);
  /// The coordinate of body 2 is `factor` times that of body 1: angle of a rotor, displacement of a slider ...
  void gear(double factor);

  /// Leaves out the measures that none of the equations feels in any position, such as those across the plane of a
  /// mechanism: the fewer there are, the cheaper is a step.
  void leave_out_idle(Pair &pair);

  /// Where both bodies move along the same direction, their difference does for the two: a pin between planar bodies
  /// has four measures, not six.
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
