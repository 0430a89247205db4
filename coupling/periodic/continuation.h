#pragma once

#include "coupling/periodic/branch_equations.h"

#include <functional>
#include <string>
#include <vector>

namespace gestell::coupling
{

/// Range and steps of a continuation.
struct ContinuationOptions
{
  double from = 0., to = 1.; ///< of the parameter
  int    points    = 100;    ///< about so many from end to end
  int    most      = 1000;   ///< points at most
  double tolerance = 1e-9;   ///< of closing()
  double located   = 1e-9;   ///< special points, of the range
};

/// A point where solutions begin, end or change their stability.
struct SpecialMotion
{
  std::string      kind; ///< "fold", "period doubling", "Neimark-Sacker", "branch", "grazing"
  double           parameter = 0.;
  PeriodicSolution solution;
  int              nearest = 0; ///< of Branch::points, along the branch
};

struct BranchPoint
{
  double           parameter = 0.;
  PeriodicSolution solution;
};

struct Branch
{
  std::vector<BranchPoint>   points;
  std::vector<SpecialMotion> special;
  std::string                ended; ///< reason; empty: at the other end of the parameter
  bool                       failed = false;
};

/// Called for each point; false: stop.
using BranchProgress = std::function<bool(const BranchPoint &)>;

/**
 * Follows a branch of periodic motions by its arclength (Keller 1977): F(z, lambda) = 0 with
 *
 *     |dz|^2/size^2 + dlambda^2/range^2 = ds^2
 *
 * along the tangent, a step that grows with quick convergence and shrinks where the branch folds or Newton's method
 * fails.
 *
 * Special points are zeros of test functions between two points, located by regula falsi in the arclength:
 *
 *     fold             dlambda/ds = 0
 *     branch           det dF/dz = 0 without a fold
 *     period doubling  prod (mu_i + 1) = 0
 *     Neimark-Sacker   |mu| = 1 of a pair of complex multipliers
 *     grazing          another number or kind of events, by bisection
 *
 * @param first     a solution at options.from
 * @throws NoPeriodicMotion, ConvergenceFailure if not even the first point is found; later failures end the branch and
 * are stored in `ended`
 */
Branch follow_branch(BranchEquations &equations, const PeriodicSolution &first, const ContinuationOptions &options,
                     const BranchProgress &progress = {});

/// Where a new branch leaves: along or against what dF/dz leaves free.
enum class Side
{
  along,
  against
};

/// The branch that leaves at a special motion, along what dF/dz leaves free there: at a period doubling with the
/// equations and the solution of the double period.  It ends where it meets the first one again.
Branch follow_new_branch(BranchEquations &equations, const SpecialMotion &from, const ContinuationOptions &options,
                         const BranchProgress &progress = {}, Side side = Side::along);

/**
 * The branches that leave at a special motion, on both sides of it.
 *
 * At a period doubling the second side is the first one period later.  Where a symmetric motion loses its symmetry it
 * is the mirror image: at equal parameters period and multipliers are equal on both, and the second is left out.
 */
std::vector<Branch> follow_new_branches(BranchEquations &equations, const SpecialMotion &from,
                                        const ContinuationOptions &options, const BranchProgress &progress = {});

} // namespace gestell::coupling
