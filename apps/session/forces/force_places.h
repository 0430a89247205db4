#pragma once

#include "apps/scene/scene.h"
#include "coupling/machine/machine.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace gestell::apps
{

/// One of the two points between which an element acts.
struct ForceSide
{
  std::string           body; ///< "slide", "frame.crown", "ground"
  coupling::PlacedPoint at;
  std::vector<int>      own; ///< coordinates that move only this side, ascending
};

/// An element between two points, with the forces on some of its measures.
struct ForceBetween
{
  std::string                    name;
  int                            first_measure = 0; ///< in p of the machine
  std::vector<coupling::Measure> measures;
  ForceSide                      first, second;
  bool                           is_load     = false; ///< it acts only on the second point
  bool                           is_coupling = false; ///< of two coordinates; bearings elsewhere may transmit a part
};

/// A force or torque in a fixed direction, of an element that acts on DOFs of markers.  It acts on the body that has
/// the DOF: on the carrier for a bearing's translation, and on the ground if that is the other side.
struct ForceAlong
{
  std::string           name, body;
  coupling::PlacedPoint at;
  Eigen::Vector3d       direction = Eigen::Vector3d::Zero(); ///< times the weight of the DOF in the measure
  bool                  turns     = false;
  int                   measure   = -1; ///< in p of the machine; -1: from `signal`
  coupling::Signal      signal{};       ///< of springs and loads
  double                sign = 1.;      ///< sign of the signal in the measure
};

/// A bearing: a rotor or a slider transmits to its carrier the forces in directions in which it has no DOF.
struct Bearing
{
  std::string           body, carrier;
  coupling::PlacedPoint of_body, of_carrier;
  Eigen::Vector3d       axis  = Eigen::Vector3d::Zero(); ///< unit vector
  bool                  turns = false;                   ///< rotates about the axis; else it slides along it
};

struct ForcePlaces
{
  std::vector<ForceBetween> between;
  std::vector<ForceAlong>   along;
  std::vector<Bearing>      bearings;
};

/// Points of force application of all elements, joints, springs and loads of a scene's machine.  Two kinds are omitted:
/// constraints that keep the directors of a body rigid are not forces, and an unbalance is inertia.
ForcePlaces force_places(const Scene &scene, const coupling::Machine &machine);

} // namespace gestell::apps
