#pragma once

#include "apps/output/pictures/mechanism_shapes.h"
#include "apps/output/pictures/scenery_skin.h"
#include "apps/output/values/scenery.h"
#include "fem/values/number_text.h"

#include <optional>
#include <string>
#include <vector>

namespace gestell::apps
{

/// A picture of a mode: the skin deformed to a twentieth of its size, coloured by displacement, over its faint
/// undeformed edges.  Seen in parallel projection from front right and above.
std::string mode_picture_svg(const Skin &skin, const std::string &title, const std::string &subtitle);

/// A field over the points of a skin.
struct SkinField
{
  Skin                           skin;
  std::vector<double>            values;   ///< [points] in SI, >= 0
  double                         top = 0.; ///< where the scale of colours ends
  DisplayUnit                    unit;     ///< of its bar
  std::optional<Eigen::Vector3d> mark;     ///< [m] a place that is ringed
};

/// A picture of a field on the skin deformed as of a mode, with the bar of its colours.
std::string field_picture_svg(const SkinField &field, const std::string &title, const std::string &subtitle);

/// A picture of the machine: the frame pale, the bodies of the mechanism over it as if the frame were glass; faint, the
/// edges of the bodies at another time.
std::string scene_picture_svg(const Skin &skin, const std::vector<Shape> &shapes, const std::string &title,
                              const std::vector<Shape> &later = {});

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

/// A mode shape of frame and mechanism about the configuration q0: bodies move by the derivative of their places.  The
/// largest displacement of all is 1 m.
MachineState mode_state(const Scenery &scenery, const Eigen::VectorXd &q0, const Eigen::VectorXd &shape);

/// The enlargement, a round number, by which the largest displacement is at most a twentieth of the size; 0 where
/// nothing moves.
double shown_enlargement(const MachineState &state);

/// Of a mode: its largest displacement, of frame or body, becomes a twentieth of the size.
double mode_enlargement(const MachineState &state);

/**
 * The deformed machine: its frame coloured by displacement and moved by enlargement times displacement over its faint
 * undeformed edges, the bodies seen through it; with axes and a scale of lengths, beside it the names of the bodies and
 * the bar of colours (without one if `unit` is empty: the displacement of a mode has no size).
 */
std::string machine_state_svg(const MachineState &state, double enlargement, const std::string &title,
                              const std::string &subtitle, const DisplayUnit &unit = {});

} // namespace gestell::apps
