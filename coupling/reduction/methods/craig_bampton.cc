#include "coupling/reduction/methods/craig_bampton.h"

#include "coupling/integration/system/convergence_failure.h"
#include "coupling/reduction/estimates/mode_selection.h"
#include "coupling/reduction/methods/reduction_space.h"
#include "coupling/reduction/shapes/fixed_interface_modes.h"
#include "coupling/reduction/shapes/interface_statics.h"
#include "fem/values/number_text.h"
#include "fem/values/two_pi.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace gestell::coupling
{

namespace
{

/// Warns of modes that end below the highest frequency of interest.
void warn_of_few_modes(ReductionSpace &space, const ReductionOptions &options)
{
  const int    m       = space.basis.m();
  const double highest = m > 0 ? space.basis.omega0(m - 1) / two_pi : 0.;
  if (options.frequency <= highest || space.basis.T.cols() == space.basis.T.rows())
    return;
  space.notes.push_back(
      "reduction: " +
      (m == 0 ? std::string("no fixed-interface modes are retained")
              : (m == 1 ? "the only retained fixed-interface mode has "
                        : "the highest of the " + std::to_string(m) + " retained fixed-interface modes has ") +
                    rounded(highest) + " Hz") +
      ", but frequency = " + rounded(options.frequency) +
      " Hz: near and above the highest mode the model is not valid and its error is unknown; request more modes, or "
      "remove reduction.modes, so that the tolerance determines their number");
}

/// Highest frequency [rad/s] up to which a given number of modes keeps all frequencies within the tolerance, or half of
/// the first frequency if there is none. Adds a statement, or in the second case a warning.
double limit_of_few_modes(ReductionSpace &space, const ReductionOptions &options)
{
  const int    m        = space.basis.m();
  const double interest = highest_of_interest(options, space.refined);
  if (options.frequency > 0.)
    return interest;
  const double known = m == 0 || space.basis.T.cols() == space.basis.T.rows() ? INFINITY : space.basis.omega0(m - 1);
  const Eigen::VectorXd &omega = space.refined.omega;
  const Eigen::VectorXd  error = frequency_estimate(space.star, space.basis.n1(), m, space.refined).error;
  Eigen::Index           j     = 0;
  while (j < omega.size() && omega[j] <= interest && omega[j] < known && j + space.refined.n_rigid < error.size() &&
         error[j + space.refined.n_rigid] <= options.tolerance)
    ++j;
  if (j == omega.size() || omega[j] > interest)
    return interest;
  const double limit = j > 0 ? omega[j - 1] : 0.5 * std::min(omega[0], known);
  const bool   off   = omega[j] < known && j + space.refined.n_rigid < error.size();
  (j > 0 ? space.statements : space.notes)
      .push_back("reduction: " + std::to_string(m) +
                 (m == 1 ? " fixed-interface mode keeps " : " fixed-interface modes keep ") +
                 (j > 0 ? "frequencies up to " + rounded(limit / two_pi) + " Hz" : "no frequency") + " within " +
                 percent(options.tolerance) + (j > 0 ? "; the next, " : "; the first, ") + rounded(omega[j] / two_pi) +
                 " Hz, " +
                 (off ? "is " + percent(error[j + space.refined.n_rigid]) + " too high"
                      : "is above the highest retained mode, where some may be missing") +
                 (m == 0 ? ", and internal modes are not computed" : "") +
                 ": request more modes, or give a frequency instead of their number");
  return limit;
}

/// The error of a number of modes that was given, where the modes reach beyond the frequency of interest.
void state_receptance(ReductionSpace &space, const InterfaceStatics &statics, const fem::FrameMatrices &frame,
                      const ReductionOptions &options)
{
  const ReductionBasis &basis  = space.basis;
  const int             m      = basis.m();
  const double          within = two_pi * options.frequency;
  if (!(within > 0.) || basis.n1() == 0 || m == 0 || within >= basis.omega0(m - 1))
    return;
  const InterfaceReceptance receptance(basis, space.star, statics.response, space.refined, frame.modal_damping_ratio,
                                       within);
  const std::string statement = receptance_statement(receptance, basis, frame.interfaces, {m}, options.frequency);
  if (has_inner_dampers(basis, frame.B))
    space.notes.push_back(
        statement +
        "; this ignores dampers inside the frame: remove reduction.modes, so that shapes for dampers are added");
  else
    space.statements.push_back(statement);
}

/// The model with as many modes as the tolerance requires.
ReductionSpace chosen(FixedInterfaceModes &fixed, InterfaceStatics &statics, const fem::FrameMatrices &frame,
                      const ReductionOptions &options)
{
  ReductionSpace space{std::move(statics.basis)};
  auto           selection = select_modes(space.basis, fixed, statics, frame, options);
  space.refined            = std::move(selection.refined);
  space.attachment         = std::move(selection.shapes);
  space.notes              = std::move(selection.notes);
  if (!selection.statement.empty())
    space.statements.push_back(selection.statement);
  statics.begin("reduced matrices");
  space.star = reduced_matrices(space.basis, frame.B);
  return space;
}

/// With options.n_modes modes.
ReductionSpace counted(FixedInterfaceModes &fixed, InterfaceStatics &statics, const fem::FrameMatrices &frame,
                       const ReductionOptions &options)
{
  ReductionSpace space{std::move(statics.basis)};
  statics.begin("fixed-interface modes");
  fixed.find(options.n_modes);
  fixed.finish();
  space.basis.set_modes(fixed.found().V.leftCols(options.n_modes), fixed.found().omega.head(options.n_modes));
  fixed.forget_shapes();
  statics.begin("reduced matrices");
  space.star    = reduced_matrices(space.basis, frame.B);
  space.refined = refined_modes(space.basis, space.star, statics.response, frame);
  state_receptance(space, statics, frame, options);
  warn_of_few_modes(space, options);
  space.limit = limit_of_few_modes(space, options);
  return space;
}

} // namespace

ReductionSpace CraigBampton::basis(const fem::FrameMatrices &frame, const ReductionOptions &options,
                                   InterfaceStatics &statics)
{
  FixedInterfaceModes fixed(statics.held, frame, statics.basis.q1);
  // of finding modes that were missing: one suffices, unless a search misses some again
  constexpr int most_rounds = 4;
  for (int round = 0; round < most_rounds; ++round)
  {
    ReductionSpace space = (options.n_modes < 0 ? chosen : counted)(fixed, statics, frame, options);
    statics.begin("count of the modes");
    if (!fixed.confirm())
    {
      statics.basis = std::move(space.basis);
      continue;
    }
    if (!fixed.statement().empty())
      space.statements.push_back(fixed.statement());
    if (options.n_modes < 0)
      space.limit = highest_of_interest(options, space.refined);
    return space;
  }
  throw ConvergenceFailure(
      "reduction: in " + std::to_string(most_rounds) +
      " rounds some fixed-interface modes were missing each time; request another number of modes");
}

} // namespace gestell::coupling
