#pragma once

#include "fem/mesh/size_field.h"
#include "fem/recovery/mesh_error.h"

#include <Eigen/Core>

#include <vector>

namespace gestell::fem
{

/// p of eta_K^2 ~ h^(2 p) as refine() supposes it.
constexpr double order_of_refinement = 1.5;

/// What refine() is to reach, and within what.
struct Refinement
{
  double growth   = 3.; ///< wanted number of cells over that of now, > 1
  double largest  = 0.; ///< [m] no element may be larger
  double smallest = 0.; ///< [m]
};

/**
 * Sizes at the corners of a mesh for a next one, with as little error as possible for the number of cells wanted.
 *
 * If the error of a cell falls as eta_K^2 ~ h^(2p), a number of cells leaves the smallest sum of errors with
 *
 *     h_new = lambda h (V_K / eta_K^2)^(1 / (2p + 3)) / h^(3/(2p + 3)),      sum_K (h / h_new)^3 = growth n_cells,
 *
 * V_K its volume; the second gives lambda.  p = order_of_refinement: between the 2 of smooth fields and the
 * 1/2 or so at edges that re-enter.  No cell grows by more than a half or shrinks below a third at a time, and from
 * point to point sizes grow by at most `size_growth` of the distance.
 *
 * @param eta2 eta_K^2 of every cell [n_cells], of fields made comparable.
 */
std::vector<SizePoint> refine(const MeshError &mesh, const Eigen::VectorXd &eta2, const Refinement &refinement);

} // namespace gestell::fem
