#pragma once

#include "apps/output/pictures/machine_state.h"
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

/**
 * The deformed machine: its frame coloured by displacement and moved by enlargement times displacement over its faint
 * undeformed edges, the bodies seen through it; with axes and a scale of lengths, beside it the names of the bodies and
 * the bar of colours (without one if `unit` is empty: the displacement of a mode has no size).
 */
std::string machine_state_svg(const MachineState &state, double enlargement, const std::string &title,
                              const std::string &subtitle, const DisplayUnit &unit = {});

} // namespace gestell::apps
