#pragma once

#include "coupling/machine/machine.h"

#include <Eigen/Core>

#include <array>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace gestell::apps
{

/// The shape of a body from its CAD file, in the reference configuration.
struct DrawnPart
{
  std::string                        body;
  std::vector<std::array<double, 3>> points;    ///< [m]
  std::vector<std::array<int, 3>>    triangles; ///< into points, outside counter-clockwise
};

/// Force and torque of an element, joint, spring or load on one body at an instant.
struct ActingForce
{
  std::string     name;         ///< of the element
  std::string     body;         ///< body on which it acts: "slide", "frame.crown", "ground"
  Eigen::Vector3d at;           ///< [m] point of application, by the motion of bodies only
  Eigen::Vector3d displacement; ///< [m] of this point with the frame, as in Shape
  Eigen::Vector3d force;        ///< [N] on the body
  Eigen::Vector3d torque;       ///< [N m] on the body, about this point
};

/// A number at each point of the frame's skin, for the 3-D view.
struct SkinField
{
  std::string         id, name, scale; ///< scale: what the colours mean
  std::vector<double> shades;          // [points of the skin] 0 to 1
  Eigen::Vector3d     mark;            ///< [m] a place that is shown
};

/// The visible parts of a machine: the skin of its frame, its interfaces and the bodies of its mechanism.
struct Scenery
{
  int n_frame = 0; ///< number of frame coordinates, the first ones of q

  std::vector<std::array<double, 3>> points;    ///< skin of the frame [m]; empty if it has none
  std::vector<std::array<int, 3>>    triangles; // into points, outside counter-clockwise
  /// Displacement [3 points; m] of the skin for the frame's coordinates [n_frame]; not called without points.
  std::function<Eigen::VectorXd(const Eigen::VectorXd &)> displacement;

  std::vector<coupling::Marker>                              interfaces;
  std::vector<std::pair<std::string, std::array<double, 3>>> interface_positions; ///< one per marker [m]
  std::vector<coupling::Body>                                bodies;
  std::vector<coupling::DrawnRod>                            rods;
  std::vector<coupling::DrawnBar>                            bars;
  std::vector<coupling::DrawnPin>                            pins;
  std::vector<DrawnPart>                                     parts; ///< bodies without one are drawn from their sizes
  std::vector<SkinField>                                     fields;

  /// Forces at t [s], q, q' [n] for the forces p [n_u] on the measures of all elements; always the same elements in the
  /// same order.  Empty: not known.
  std::function<std::vector<ActingForce>(double t, const Eigen::VectorXd &q, const Eigen::VectorXd &v,
                                         const Eigen::VectorXd &p)>
      forces;

  bool has_skin() const { return !points.empty(); }

  /// Length [m] of the diagonal of the box around all visible parts in the reference configuration; 1 m if there are
  /// none.
  double size() const;
};

/// Scenery of a finished machine.  The skin's displacement refers to the machine, which must outlive it.
Scenery scenery_of(const coupling::Machine &machine);

/// u = w . q
double value(const coupling::Measure &measure, const Eigen::VectorXd &q);

/// Displacement [m] of a marker's origin for q.
Eigen::Vector3d translation(const coupling::Marker &marker, const Eigen::VectorXd &q);

/// Position [m] of a point at q, also for large rotations of its body.
Eigen::Vector3d position(const coupling::PlacedPoint &place, const Eigen::VectorXd &q);

/// Direction at q of a vector e that is fixed to the body of the point.
Eigen::Vector3d direction(const coupling::PlacedPoint &place, const Eigen::Vector3d &e, const Eigen::VectorXd &q);

} // namespace gestell::apps
