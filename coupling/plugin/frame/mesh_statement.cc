#include "coupling/plugin/frame/mesh_statement.h"

#include "coupling/algebra/dense_modes.h"
#include "coupling/algebra/sparse_cholesky.h"
#include "coupling/integration/system/convergence_failure.h"
#include "coupling/modes/modes.h"
#include "coupling/reduction/estimates/raised_modes.h"
#include "fem/mesh/memory_estimate.h"
#include "fem/mesh/wall_thickness.h"
#include "fem/values/number_text.h"
#include "fem/values/two_pi.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace gestell::coupling
{

namespace
{

struct Modes
{
  int             n_rigid;
  DenseModes      ritz;
  Eigen::VectorXd omega;  // without the error of the reduction where that is known
  int             within; // elastic ones up to the limit
};

Modes modes_of(const ReducedModel &reduced)
{
  const int       n_rigid = reduced.frame.n_rigid();
  DenseModes      ritz    = dense_modes(reduced.frame.C, reduced.frame.M, cancelled_by_reduction, n_rigid);
  Eigen::VectorXd omega   = ritz.omega;
  for (Eigen::Index j = n_rigid; j < omega.size(); ++j)
    if (const double refined = two_pi * refined_hz(reduced.frame, j); !std::isnan(refined))
      omega[j] = refined;
  // The limit may be the refined frequency of a mode, in other digits.
  const double limit  = (1. + 1e-6) * two_pi * reduced.frame.frequency_limit_hz;
  const auto   within = static_cast<int>((omega.array() <= limit).count() - n_rigid);
  return {n_rigid, std::move(ritz), std::move(omega), within};
}

/// The first mode, the last one and some between them.
std::vector<int> some_of(const Modes &modes)
{
  std::vector<int> looked_at;
  constexpr int    most_modes = 6; // modes whose stresses are computed: each costs as much as a static solution
  for (int j = 0, count = std::min(modes.within, most_modes); j < count; ++j)
    looked_at.push_back(modes.n_rigid + (count > 1 ? j * (modes.within - 1) / (count - 1) : 0));
  return looked_at;
}

/// Errors of frequencies from the stresses of some modes.
Eigen::VectorXd by_stresses(const Modes &modes, const ReducedModel &reduced, const fem::MeshError &mesh_error)
{
  const std::vector<int> looked_at = some_of(modes);
  Eigen::VectorXd share = mesh_error.of_cells(reduced.basis.T * modes.ritz.V(Eigen::all, looked_at)).colwise().sum();
  share.array() /= modes.ritz.omega(looked_at).array().square();
  return share.unaryExpr([](double s) { return fem::relative_frequency_error(s); });
}

// Largest numbers of coordinates of degree three for which the comparison is worth two to three and a half times the
// cost of the reduction (docs/theory/mesh_error.md): some 15 CPU s for thin walls, whose bending stresses do not
// show, and 3 s for bodies, for which stresses suffice.
constexpr double most_of_walls = 4e5, most_of_bodies = 6e4;

/// Errors of frequencies from elements of degree three; empty if these cost too much.
Eigen::VectorXd by_degree(const Modes &modes, const ReducedModel &reduced, const fem::FrameMatrices &frame,
                          const fem::MeshError &mesh_error, bool thin_walls)
{
  if (frame.C.nonZeros() == 0)
    return {}; // of a frame in parts or on ranks, whose matrices are not kept
  const double n                  = fem::raised_coordinates(mesh_error.mesh(), double(frame.M.rows())),
               available          = fem::available_memory();
  constexpr double bytes_per_cell = 1e5; // of the matrices, during assembly
  if (n > (thin_walls ? most_of_walls : most_of_bodies) ||
      2. * bytes_per_cell * mesh_error.mesh().n_cells() > available)
    return {};
  constexpr int most_raised = 24; // modes that are compared with degree three
  constexpr int guard_modes = 4;  // further modes, which keep the last compared ones accurate
  const int     count       = std::min(modes.within, most_raised),
            taken           = std::min<int>(count + guard_modes, int(modes.ritz.omega.size()) - modes.n_rigid);
  const Eigen::MatrixXd X   = reduced.basis.T * modes.ritz.V.middleCols(modes.n_rigid, taken);
  Eigen::VectorXd       raised;
  try
  {
    raised = raised_frequencies(mesh_error.raised(frame), X, modes.ritz.omega.segment(modes.n_rigid, taken),
                                modes.n_rigid > 0, available, reduced.factor);
  }
  catch (const NotEnoughMemory &)
  {
    return {};
  }
  catch (const ConvergenceFailure &) // the same, of a rank
  {
    return {};
  }
  catch (const NotPositiveDefinite &)
  {
    return Eigen::VectorXd::Constant(count, INFINITY); // a prestressed frame that buckles in softer elements
  }
  Eigen::VectorXd error(count);
  for (int j = 0; j < count; ++j)
    error[j] = error_by_raising(modes.omega[modes.n_rigid + j], raised[j]);
  return error;
}

} // namespace

bool may_be_raised(const fem::MeshError &mesh_error, double n)
{
  return fem::raised_coordinates(mesh_error.mesh(), n) <= most_of_walls;
}

MeshErrorEstimate modal_mesh_error(const ReducedModel &reduced, const fem::FrameMatrices &frame,
                                   const fem::MeshError &mesh_error, bool thin_walls)
{
  const Modes modes = modes_of(reduced);
  if (modes.within <= 0)
    return {};
  const double limit = reduced.frame.frequency_limit_hz;
  if (Eigen::VectorXd error = by_degree(modes, reduced, frame, mesh_error, thin_walls); error.size() > 0)
  {
    const double last = reduced.frame.frequencies_hz[modes.n_rigid + error.size() - 1];
    const bool   all  = error.size() == modes.within;
    return {std::move(error), all ? limit : last, true};
  }
  return {by_stresses(modes, reduced, mesh_error), limit, false};
}

double tie_error(const ReducedModel &reduced, const fem::MeshError &mesh_error)
{
  const Modes modes = modes_of(reduced);
  if (mesh_error.mesh().ties.empty() || modes.within <= 0)
    return 0.;
  const std::vector<int> looked_at = some_of(modes);
  const Eigen::VectorXd  work      = mesh_error.of_ties(reduced.basis.T * modes.ritz.V(Eigen::all, looked_at));
  return 0.5 * (work.array() / modes.ritz.omega(looked_at).array().square()).maxCoeff();
}

MeshStatement mesh_statement(const ReducedModel &reduced, const fem::FrameMatrices &frame,
                             const fem::MeshError &mesh_error, const fem::Mesh &mesh)
{
  const fem::WallThickness walls = fem::wall_thickness(mesh);
  // share of the skin on walls thinner than the elements from which they count
  constexpr double thin               = 0.05;
  const bool       thin_walls         = walls.thin_share > thin;
  const auto [error, highest, raised] = modal_mesh_error(reduced, frame, mesh_error, thin_walls);
  bool        warns                   = false;
  std::string text                    = "mesh: " + std::to_string(reduced.frame.n_full) + " DOFs";
  if (error.size() > 0)
  {
    const double low = error.minCoeff(), high = error.maxCoeff();
    text += std::string("; estimated by ") + (raised ? "elements of degree three" : "the stresses of the modes") +
            ", frequencies up to " + rounded(highest, 3) + " Hz are ";
    if (!raised && thin_walls)
      text += "at least ";
    text += std::isfinite(high) ? percent(low, 2) + (low < high ? " to " + percent(high, 2) : "") +
                                      " too high, the first by " + percent(error[0], 2)
                                : "useless: the error is as large as the energy";
    if (thin_walls)
      text += "; " + percent(walls.thin_share, 2) + " of the surface is on walls thinner than the elements, " +
              rounded(walls.median_ratio, 3) + " times on average (thinnest wall " +
              rounded(1000. * walls.thinnest, 3) + " mm)" +
              (raised ? "" : ", whose bending error the stresses do not show");
    if (const std::size_t ties = mesh.ties.size(); ties > 0)
      text += "; " + std::to_string(ties) + (ties == 1 ? " tie" : " ties") +
              " between meshes of solids change them by up to " + percent(tie_error(reduced, mesh_error), 2);
    constexpr double coarse = 0.02; // error from which it is a warning, with a way out
    // element size over thickness above which stresses miss much of the error in bending
    constexpr double long_beside_wall = 2.;
    warns = !(high < coarse) || (!raised && thin_walls && walls.median_ratio > long_beside_wall);
    if (warns)
      text += std::string("; `gestell modes --converge 0.01` of a frame from CAD refines until they are within 1 %") +
              (mesh.cells.empty() || !mesh.hexahedra.empty()
                   ? ""
                   : ", hexahedra through thin walls (mesh.plates = \"swept\") need far fewer DOFs");
  }
  return {std::move(text), warns};
}

} // namespace gestell::coupling
