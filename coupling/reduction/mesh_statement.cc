#include "coupling/reduction/mesh_statement.h"

#include "coupling/dense_modes.h"
#include "coupling/reduction/rounded.h"
#include "fem/two_pi.h"
#include "fem/wall_thickness.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace gestell::coupling
{

namespace
{

constexpr int    most_modes = 6;    // whose stresses are looked at: each costs as much as a static solution
constexpr double coarse     = 0.02; // error from which it is a warning, with a way out

} // namespace

Eigen::VectorXd modal_mesh_error(const Reduction &reduced, const fem::MeshError &mesh_error)
{
  const int        n_rigid = reduced.frame.n_rigid();
  const DenseModes ritz    = dense_modes(reduced.frame.C, reduced.frame.M, cancelled_by_reduction, n_rigid);
  const double     limit   = (1. + 1e-6) * two_pi * reduced.frame.frequency_limit_hz;
  const auto       within  = static_cast<int>((ritz.omega.array() <= limit).count() - n_rigid);
  std::vector<int> looked_at; // the first, the last and some between
  for (int j = 0, count = std::min(within, most_modes); j < count; ++j)
    looked_at.push_back(n_rigid + (count > 1 ? j * (within - 1) / (count - 1) : 0));
  Eigen::VectorXd share = mesh_error.of_cells(reduced.basis.T * ritz.V(Eigen::all, looked_at)).colwise().sum();
  share.array() /= ritz.omega(looked_at).array().square();
  return share.unaryExpr([](double s) { return fem::relative_frequency_error(s); });
}

MeshStatement mesh_statement(const Reduction &reduced, const fem::MeshError &mesh_error, const fem::Mesh &mesh)
{
  const Eigen::VectorXd error = modal_mesh_error(reduced, mesh_error);
  bool                  warns = false;
  std::string           text  = "mesh: " + std::to_string(reduced.frame.n_full) + " coordinates";
  if (error.size() > 0)
  {
    const double low = error.minCoeff(), high = error.maxCoeff();
    text += "; judged by the stresses of the modes, frequencies up to " + rounded(reduced.frame.frequency_limit_hz, 3) +
            " Hz are ";
    text += std::isfinite(high) ? percent(low, 2) + (low < high ? " to " + percent(high, 2) : "") +
                                      " too high, the first by " + percent(error[0], 2)
                                : "of no use: errors take up the whole energy";
    const fem::WallThickness walls = fem::wall_thickness(mesh);
    if (walls.thin_share > 0.05)
      text += "; " + percent(walls.thin_share, 2) + " of the surface belongs to walls thinner than the elements, " +
              rounded(walls.median_ratio, 3) + " times on the average (thinnest wall " +
              rounded(1000. * walls.thinnest, 3) + " mm)";
    warns = !(high < coarse);
    if (warns)
      text += "; `gestell modes --converge 0.01` refines until they are within 1 %, hexahedra through thin walls need "
              "far fewer coordinates";
  }
  return {std::move(text), warns};
}

} // namespace gestell::coupling
