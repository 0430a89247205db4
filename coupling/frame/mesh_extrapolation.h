#pragma once

#include <vector>

namespace gestell::coupling
{

/// A quantity on one mesh.
struct MeshValue
{
  double coordinates = 0.; ///< n, number of DOFs
  double value       = 0.;
  double estimate    = 0.; ///< relative error by an estimator, >= 0; only the ratio between meshes matters
};

/// Side from which values converge: conforming elements make frequencies too high, compliances too low.
enum class Approach
{
  from_above,
  from_below
};

/// Meshes below this ratio of DOFs to a coarser one mainly show scatter of the cells.
constexpr double distinctly_finer = 1.2;

struct Extrapolated
{
  double limit       = 0.;   ///< value for n -> infinity
  double uncertainty = 0.;   ///< of the limit, relative
  double order       = 0.;   ///< k of  error ~ n^(-k); NaN with fewer than three meshes, or if the values show no order
  bool   regular     = true; ///< the values approach the limit from mesh to mesh and never retreat
  int    n_meshes    = 0;    ///< number of meshes used, each distinctly finer than the one before
};

/**
 * Limit of the values v_1, v_2, ... of increasingly fine meshes (Richardson extrapolation).
 *
 * If the error of each mesh is r times that of the previous one,
 *
 *     v = v_m - (v_(m-1) - v_m) r / (1 - r).
 *
 * r is computed in two ways.  From the estimator: r = estimate_m / estimate_(m-1), which needs two meshes and is valid
 * if the estimator is wrong by the same factor on both.  From the values of three meshes: r = (n_(m-1) / n_m)^k with
 * the k that fits error = c n^(-k) to them.  With three or more meshes the limit follows from the values; its
 * uncertainty is the difference to the limit from the estimator (with four or more meshes also that to the limit of the
 * previous three, if smaller), but at least half of the correction.  With two meshes the limit follows from the
 * estimator, and the uncertainty is the whole correction.  With one mesh the limit is its value, and the uncertainty is
 * its estimate.  If values converge faster than any k up to 4, the first of the three meshes was too coarse: k = 1 is
 * used, and the uncertainty is the whole correction.
 *
 * With up to three meshes the resulting error is at least half of the estimate of the last mesh.
 *
 * Meshes that are not distinctly finer than a coarser one are skipped.  Values are not regular if one of the last two
 * steps leads away from the limit, or if the limit does not exceed all values in the direction of convergence.  The
 * correction is then the estimate of the last mesh, or the distance to the value nearest to the limit if that is
 * larger; the uncertainty is the larger of this correction and the step away.  Therefore the limit of values that
 * converge from above is never above the lowest of them.
 *
 * @param meshes  at least one, of growing n; values above zero.
 * @throws std::invalid_argument if there is none.
 *
 * Source: Roache, J. Fluids Eng. 116, 1994, 405-413; docs/theory/mesh_error.md (6-8).
 */
Extrapolated extrapolate(const std::vector<MeshValue> &meshes, Approach approach);

} // namespace gestell::coupling
