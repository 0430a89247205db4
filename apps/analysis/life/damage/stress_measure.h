#pragma once

#include "coupling/frame/stress_field.h"

#include <Eigen/Core>

#include <vector>

namespace gestell::apps
{

/// Scalar of a stress history of which cycles are counted.
enum class StressMeasure
{
  normal,           ///< stress across a weld: t.sigma.t, t = normal x weld, in the surface
  shear,            ///< stress along a weld: weld.sigma.t
  signed_von_mises, ///< von Mises stress with the sign of the trace (hydrostatic stress), see signed_von_mises()
  critical_plane    ///< n.sigma.n of the plane n of the largest damage
};

/// Directions at a point; zero where they are not known.
struct SurfaceDirections
{
  Eigen::Vector3d normal = Eigen::Vector3d::Zero(); ///< outward, of length 1
  Eigen::Vector3d weld   = Eigen::Vector3d::Zero(); ///< along the weld, of length 1, in the surface
};

/// Which points, how many of the worst, and which scalar of their stresses.
struct DamageSearch
{
  StressMeasure                  measure = StressMeasure::critical_plane;
  std::vector<SurfaceDirections> directions; ///< [points] or empty: not known
  std::vector<char>              counts;     ///< [points] included in the search
  int                            worst    = 1;
  double                         distance = 0.; ///< [m] between any two of the worst points, see `position`
  std::vector<Eigen::Vector3d>   position;      ///< [points], needed for a distance > 0
  double                         factor = 1.;   ///< on stresses (hot spot, safety), > 0
};

struct PointDamage
{
  int                         point  = -1;
  double                      damage = 0.; ///< of one repetition of the load
  Eigen::Matrix<double, 1, 6> row =
      Eigen::Matrix<double, 1, 6>::Zero(); ///< of a linear measure, of `critical_plane` the worst
};

/// Rows w of stress measures w.sigma that are linear in the stress.
using MeasureRows = Eigen::Matrix<double, Eigen::Dynamic, 6>;

/**
 * Rows of a linear measure at a point: one for `normal` and `shear`; for `critical_plane` one for each plane:
 * where the surface's normal is known, its 18 planes perpendicular to the surface, 10 degrees apart (at a free surface
 * the principal stress of the largest range is in the surface); otherwise planes of a hemisphere, at most 10 degrees
 * from any direction.
 * @throws std::invalid_argument: `normal`, `shear` without directions
 */
MeasureRows measure_rows(StressMeasure measure, const SurfaceDirections &at);

/// Between neighbouring planes of `critical_plane` [rad].
constexpr double step_of_planes = 0.174532925199432958;
/// Row of n.sigma.n.
Eigen::Matrix<double, 1, 6> normal_stress_row(const Eigen::Vector3d &n);
/// n of a row of `critical_plane`: row = (n_x^2, n_y^2, n_z^2, 2 n_x n_y, 2 n_y n_z, 2 n_x n_z).
Eigen::Vector3d plane_normal(const Eigen::Matrix<double, 1, 6> &row);

/// Of the von Mises stress: a trace above -1e-6 sigma_v may be rounding of stresses in single precision, and has the
/// sign +.
constexpr double trace_of_rounding = 1e-6;

/// Von Mises stress with the sign of the trace, - if the trace is below -trace_of_rounding times it.
double signed_von_mises(const coupling::Stress &sigma);
/// w with w.sigma = signed_von_mises(sigma), its derivative where it has one; zero for a stress without a deviator.
Eigen::Matrix<double, 1, 6> signed_von_mises_row(const coupling::Stress &sigma);

} // namespace gestell::apps
