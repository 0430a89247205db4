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

/// The shape of a body as its CAD file shows it, in the position the scene describes.
struct DrawnPart
{
  std::string                        body;
  std::vector<std::array<double, 3>> points;    ///< [m]
  std::vector<std::array<int, 3>>    triangles; ///< into points, outside counter-clockwise
};

/// What an element, joint, spring or load does to one body at an instant.
struct ActingForce
{
  std::string     name;         ///< of the element
  std::string     body;         ///< on which it acts: "slide", "frame.crown", "ground"
  Eigen::Vector3d at;           ///< [m] where, by the motion of bodies alone
  Eigen::Vector3d displacement; ///< [m] with that of the frame, as of Shape
  Eigen::Vector3d force;        ///< [N] on the body
  Eigen::Vector3d torque;       ///< [N m] on the body, about that place
};

/// What can be seen of a machine: the skin of its frame, its interfaces and the bodies of its mechanism.
struct Scenery
{
  int n_frame = 0; ///< coordinates of the frame, the first ones of q

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
  std::vector<DrawnPart>                                     parts; ///< bodies without one are drawn by their sizes

  /// Forces at t [s], q, q' [n] with the forces p [n_u] on the measures of all elements, always the same ones in one
  /// order; empty: not known.
  std::function<std::vector<ActingForce>(double t, const Eigen::VectorXd &q, const Eigen::VectorXd &v,
                                         const Eigen::VectorXd &p)>
      forces;

  bool has_skin() const { return !points.empty(); }

  /// Length [m] of the diagonal of the box around all that can be seen, as the scene describes it; 1 m if there is
  /// none.
  double size() const;
};

/// Takes the picture of a finished machine.  The skin's displacement refers to the machine, which must outlive it.
Scenery scenery_of(const coupling::Machine &machine);

/// u = w . q
double value(const coupling::Measure &measure, const Eigen::VectorXd &q);

/// Displacement [m] of a marker's origin for q.
Eigen::Vector3d translation(const coupling::Marker &marker, const Eigen::VectorXd &q);

/// Where [m] a place is for q, however far its body has turned.
Eigen::Vector3d position(const coupling::PlacedPoint &place, const Eigen::VectorXd &q);

/// Where a direction e fixed to the body of a place points for q.
Eigen::Vector3d direction(const coupling::PlacedPoint &place, const Eigen::Vector3d &e, const Eigen::VectorXd &q);

} // namespace gestell::apps
