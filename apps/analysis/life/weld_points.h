#pragma once

#include "apps/analysis/life/life_skin.h"
#include "apps/scene/values/life_request.h"
#include "fem/values/frame_specification.h"

#include <map>
#include <string>
#include <vector>

namespace gestell::apps
{

/// Stresses along a weld, as those of points of a skin of its own.
struct WeldPoints
{
  coupling::ReducedStress        stress;
  std::vector<Eigen::Vector3d>   position;   ///< [points] m, on the weld
  std::vector<SurfaceDirections> directions; ///< weld = normal x direction across it
  std::vector<int>               skin;       ///< [points] of the frame's skin, the one of the largest weight
  std::vector<std::string>       doubts;     ///< warnings about its stresses
};

/**
 * The points of an area or of a line where two surfaces meet.  With a thickness t the stress at a line is the
 * polynomial through those at the distances delta_k t in the first surface, perpendicular to the line, at distance
 * zero,
 *
 *     sigma = sum_k L_k sigma(delta_k t),     L_k = prod_{j != k} delta_j / (delta_j - delta_k),
 *
 * each linear in the triangle in which it lies; 1.67 and -0.67 for 0.4 and 1.  Points from which the surface does not
 * reach that far are omitted, with a warning.  An element that extends further across the line than from it to the
 * first distance, or from one distance to the next, makes the result doubtful: it mixes their stresses with the
 * singular one at the line.
 *
 * @throws std::invalid_argument with the place of the weld: no such points
 *
 * Source: Hobbacher, Recommendations for fatigue design of welded joints and components (IIW), 2.2.3: elements of at
 * most 0.4 t for the distances 0.4 and 1 or 0.4, 0.9 and 1.4.
 */
WeldPoints weld_points(const WeldRequest &weld, const std::map<std::string, fem::SurfaceSelector> &surfaces,
                       const coupling::ReducedStress &stress, const LifeSkin &skin);

} // namespace gestell::apps
