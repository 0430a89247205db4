#pragma once

#include "apps/output/pictures/shape.h"
#include "apps/output/pictures/skin.h"
#include "apps/output/values/scenery.h"

#include <Eigen/Core>

#include <vector>

namespace gestell::apps
{

constexpr double shown_size = 0.05; ///< largest displacement in a picture as a share of the drawn size

/// One state of a machine: the skin of its frame and its bodies, displacements true to scale.
struct MachineState
{
  Skin               skin;
  std::vector<Shape> shapes;

  double size() const; ///< [m] diagonal of the box around frame and bodies
  /// Largest displacement [m] of the frame, or of the bodies if the frame has no skin.
  double largest_displacement() const;
};

/// The machine at coordinates q.
MachineState machine_state(const Scenery &scenery, const Eigen::VectorXd &q);

/// Distance [m] of each point between `before` and `after`, by shape.  The two ends of a round bar are compared as
/// wholes, because its rotation about its own axis is not defined.
std::vector<std::vector<Eigen::Vector3d>> differences(const Scenery &scenery, const std::vector<Shape> &before,
                                                      const std::vector<Shape> &after);

/// Displacement [m] of each point of the bodies in a mode shape about the configuration q0, by shape: the derivative of
/// their positions.
std::vector<std::vector<Eigen::Vector3d>> body_mode(const Scenery &scenery, const Eigen::VectorXd &q0,
                                                    const Eigen::VectorXd &shape);

/// The enlargement, a round number, for which the largest displacement is at most a twentieth of the size; 0 if nothing
/// moves.
double shown_enlargement(const MachineState &state);

} // namespace gestell::apps
