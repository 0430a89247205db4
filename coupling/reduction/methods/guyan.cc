#include "coupling/reduction/methods/guyan.h"

#include "coupling/reduction/methods/reduction_space.h"
#include "coupling/reduction/shapes/interface_statics.h"
#include "fem/values/number_text.h"
#include "fem/values/two_pi.h"

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace gestell::coupling
{

namespace
{

/// Elastic frequencies of the frame [rad/s] about the first that the model has too high.
struct Reach
{
  double good = 0., bad = INFINITY;
};

Reach reach_of(const ReductionSpace &space, double tolerance)
{
  const auto errors = frequency_estimate(space.star, space.basis.n1(), 0, space.refined).error;
  Reach      reach;
  for (int j = 0; j < space.refined.omega.size(); ++j)
  {
    const bool within                 = errors(space.refined.n_rigid + j) <= tolerance;
    (within ? reach.good : reach.bad) = space.refined.omega(j);
    if (!within)
      break;
  }
  return reach;
}

/// States whether the model is valid up to its limit: error of its frequencies, and number of missing internal modes.
void judge(ReductionSpace &space, const FixedInterfaceFrame &held, const Reach &reach, double tolerance)
{
  const int         missing = space.limit > 0. ? held.below(space.limit).negative : 0;
  const std::string limit   = rounded(space.limit / two_pi) + " Hz";
  if (space.limit > 0. && missing == 0 && reach.bad > space.limit)
    space.statements.push_back("reduction: frequencies of the reduced frame up to " + limit + " are at most " +
                               percent(tolerance) +
                               " above those of the frame (estimate); no fixed-interface mode is below");
  const std::string way = "; method = \"craig-bampton\" is valid to higher frequencies";
  if (missing > 0)
    space.notes.push_back("reduction: the frame has " + std::to_string(missing) + " fixed-interface modes below " +
                          limit + ", which the static shapes omit" + way);
  if (reach.bad <= space.limit || (space.limit == 0. && std::isfinite(reach.bad)))
    space.notes.push_back("reduction: the reduced frame has the frequency of " + rounded(reach.bad / two_pi) +
                          " Hz more than " + percent(tolerance) + " too high (estimate)" + way);
}

} // namespace

ReductionSpace Guyan::basis(const fem::FrameMatrices &frame, const ReductionOptions &options, InterfaceStatics &statics)
{
  if (statics.basis.n1() == 0)
    throw std::invalid_argument((options.place.empty() ? std::string("reduction") : options.place) +
                                ": Guyan reduction retains the DOFs of interfaces, but the frame has none; give it a "
                                "[frame.interface.NAME], or use modes by method = \"craig-bampton\"");
  statics.held.release();
  statics.begin("reduced matrices");
  ReductionSpace space{std::move(statics.basis)};
  space.star        = reduced_matrices(space.basis, frame.B);
  space.refined     = refined_modes(space.basis, space.star, statics.response, frame);
  const Reach reach = reach_of(space, options.tolerance);
  space.limit       = options.frequency > 0. ? two_pi * options.frequency : reach.good;
  statics.begin("count of the modes");
  judge(space, statics.held, reach, options.tolerance);
  return space;
}

} // namespace gestell::coupling
