#pragma once

#include "fem/mesh/size_field.h"
#include "fem/recovery/mesh_error.h"

#include <Eigen/Core>

#include <vector>

namespace gestell::fem
{

/// p of eta_K^2 ~ h^(2 p), as assumed by refine().
constexpr double order_of_refinement = 1.5;

/// Target and limits of refine().
struct Refinement
{
  double growth   = 3.; ///< ratio of the new number of cells to the present one, > 1
  double largest  = 0.; ///< [m] upper limit of the element size
  double smallest = 0.; ///< [m]
};

/**
 * Sizes at the corners of a mesh for the next mesh, with the least error for the requested number of cells. If the
 * error of a cell falls as eta_K^2 ~ h^(2p), the sum of errors for a number of cells is smallest with
 *
 *     h_new = lambda h (V_K / eta_K^2)^(1 / (2p + 3)) / h^(3/(2p + 3)),      sum_K (h / h_new)^3 = growth n_cells,
 *
 * V_K its volume; the second gives lambda.  p = order_of_refinement: between 2 for smooth fields and about 1/2 at
 * re-entrant edges.  No cell grows by more than a half or shrinks below a third at a time, and from point to point
 * sizes grow by at most `size_growth` of the distance.
 *
 * @param eta2 eta_K^2 of every cell [n_cells], of fields made comparable.
 */
std::vector<SizePoint> refine(const MeshError &mesh, const Eigen::VectorXd &eta2, const Refinement &refinement);

} // namespace gestell::fem
