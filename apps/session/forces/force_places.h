#pragma once

#include "apps/scene/scene.h"
#include "coupling/machine/machine.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace gestell::apps
{

/// One of the two places between which an element acts.
struct ForceSide
{
  std::string           body; ///< "slide", "frame.crown", "ground"
  coupling::PlacedPoint at;
  std::vector<int>      own; ///< coordinates that move it and not the other one, ascending
};

/// An element between two places, by the forces on some of its measures.
struct ForceBetween
{
  std::string                    name;
  int                            first_measure = 0; ///< in p of the machine
  std::vector<coupling::Measure> measures;
  ForceSide                      first, second;
  bool                           is_load     = false; ///< it acts on the second place alone
  bool                           is_coupling = false; ///< of two coordinates, which bearings elsewhere take part in
};

/// A force or torque along a fixed direction, of an element that acts on motions of markers: on the body whose
/// coordinate the motion is, so on the carrier for a bearing's translation, and on the ground where it is the partner.
struct ForceAlong
{
  std::string           name, body;
  coupling::PlacedPoint at;
  Eigen::Vector3d       direction = Eigen::Vector3d::Zero(); ///< times the weight of the motion in the measure
  bool                  turns     = false;
  int                   measure   = -1; ///< in p of the machine; -1: by the signal
  coupling::Signal      signal{};       ///< of springs and loads
  double                sign = 1.;      ///< with which the signal acts on the measure
};

/// Where a rotor or a slider passes on to its carrier what it has no motion for.
struct Bearing
{
  std::string           body, carrier;
  coupling::PlacedPoint of_body, of_carrier;
  Eigen::Vector3d       axis  = Eigen::Vector3d::Zero(); ///< unit vector
  bool                  turns = false;                   ///< about the axis; else it slides along it
};

struct ForcePlaces
{
  std::vector<ForceBetween> between;
  std::vector<ForceAlong>   along;
  std::vector<Bearing>      bearings;
};

/// Of all elements, joints, springs and loads of a scene's machine.  What keeps the directors of a body rigid is no
/// force, and an unbalance is inertia: both are left out.
ForcePlaces force_places(const Scene &scene, const coupling::Machine &machine);

} // namespace gestell::apps
