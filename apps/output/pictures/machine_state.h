#pragma once

#include "apps/output/pictures/shape.h"
#include "apps/output/pictures/skin.h"
#include "apps/output/values/scenery.h"

#include <Eigen/Core>

#include <vector>

namespace gestell::apps
{

constexpr double shown_size = 0.05; ///< of a picture: largest displacement as part of what is drawn

/// A machine in one state: its frame's skin and its bodies, displacements not yet enlarged.
struct MachineState
{
  Skin               skin;
  std::vector<Shape> shapes;
  double             scale = 1.; ///< of a mode: what its shape was multiplied with

  double size() const; ///< [m] diagonal of the box around all of it
  /// Largest displacement [m] of the frame, of bodies where it has no skin.
  double largest_displacement() const;
};

/// The machine for its coordinates q.
MachineState machine_state(const Scenery &scenery, const Eigen::VectorXd &q);

/// How far [m] each point of `after` is from where it was in `before`, by shape.  The two ends of a round bar move as
/// wholes: about its own axis nothing tells how it has turned.
std::vector<std::vector<Eigen::Vector3d>> differences(const Scenery &scenery, const std::vector<Shape> &before,
                                                      const std::vector<Shape> &after);

/// Displacement [m] of each point of the bodies in a mode shape about the configuration q0, by shape: the derivative of
/// their places.
std::vector<std::vector<Eigen::Vector3d>> body_mode(const Scenery &scenery, const Eigen::VectorXd &q0,
                                                    const Eigen::VectorXd &shape);

/// The same of frame and mechanism.  The largest displacement of all is 1 m.
MachineState mode_state(const Scenery &scenery, const Eigen::VectorXd &q0, const Eigen::VectorXd &shape);

/// The enlargement, a round number, by which the largest displacement is at most a twentieth of the size; 0 where
/// nothing moves.
double shown_enlargement(const MachineState &state);

/// Of a mode: its largest displacement, of frame or body, becomes a twentieth of the size.
double mode_enlargement(const MachineState &state);

} // namespace gestell::apps
