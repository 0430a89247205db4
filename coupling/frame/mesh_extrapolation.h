#pragma once

#include <vector>

namespace gestell::coupling
{

/// A quantity of one mesh.
struct MeshValue
{
  double coordinates = 0.; ///< n, number of them
  double value       = 0.;
  double estimate    = 0.; ///< relative error by an estimator, >= 0; only its fall from mesh to mesh counts
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
  double order       = 0.;   ///< k of  error ~ n^(-k); NaN with fewer than three meshes or where the values tell none
  bool   regular     = true; ///< values that moved towards the limit from mesh to mesh, and not away from it
  int    n_meshes    = 0;    ///< distinctly finer than the one before, on which the limit rests
};

/**
 * Limit of values v_1, v_2, ... of ever finer meshes (Richardson).
 *
 * With the error of each mesh r times that of the one before it,
 *
 *     v = v_m - (v_(m-1) - v_m) r / (1 - r).
 *
 * r is known in two ways: from the estimator, r = estimate_m / estimate_(m-1), which needs two meshes and holds if it
 * is wrong by the same factor on both; and from three meshes, by the k that fits error = c n^(-k) to their values,
 * r = (n_(m-1) / n_m)^k.  Three meshes give the limit by the second way, uncertain by the difference to the first, or
 * from four meshes on to the limit of the three before where that is nearer, and by at least half of the correction;
 * two meshes the first way, uncertain by the whole step; one mesh its own estimate, uncertain by all of it.  Values
 * that settle faster than any k up to 4 were far from their order on the first of three meshes: the rest is taken with
 * k = 1, all of it doubted.
 *
 * Up to three meshes the error is not stated to be below half of the estimate of the last one.
 *
 * Meshes not distinctly finer than a coarser one are left out.  Values of which one
 * of the last two steps leads away from the side of the limit, or the limit not past the nearest of them, are not
 * regular: then the rest is the estimate of the last mesh, or up to the nearest value where that is more, and uncertain
 * by as much and by the step away.  So the limit is never above the lowest value of those that come from above.
 *
 * @param meshes  at least one, of growing n; values above zero.
 * @throws std::invalid_argument if there is none.
 *
 * Source: Roache, J. Fluids Eng. 116, 1994, 405-413; docs/theory/mesh_error.md (6-8).
 */
Extrapolated extrapolate(const std::vector<MeshValue> &meshes, Approach approach);

} // namespace gestell::coupling
