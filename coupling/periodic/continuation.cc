#include "coupling/periodic/continuation.h"

#include "coupling/integration/system/dense_solvers.h"
#include "coupling/periodic/branch_follower.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

namespace gestell::coupling
{

namespace
{
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Point  = BranchFollower::Point;
using Detail = BranchFollower::Detail;

double slope_of(const Point &point)
{
  return point.tangent[point.tangent.size() - 1];
}

/// prod (mu_i - mu), multipliers near zero and the trivial one left out; real, as they come in pairs.
double product(const PeriodicSolution &solution, double mu)
{
  Index trivial = -1;
  if (solution.trivial_multiplier && solution.multipliers.size() > 0)
    (solution.multipliers.array() - 1.).abs().minCoeff(&trivial);
  std::complex<double> value = 1.;
  for (Index i = 0; i < solution.multipliers.size(); ++i)
    if (i != trivial)
    {
      const std::complex<double> factor = solution.multipliers[i] - mu;
      value *= factor / std::max(1., std::abs(factor));
    }
  return value.real();
}

/// Size of the largest complex multiplier above 1; below where there is none.
double largest_pair(const PeriodicSolution &solution)
{
  double largest = -1.;
  for (const auto &mu : solution.multipliers)
    if (mu.imag() != 0.)
      largest = std::max(largest, std::abs(mu) - 1.);
  return largest;
}

/// How often each event happens.
std::map<std::string, int> signature(const PeriodicSolution &solution)
{
  std::map<std::string, int> counts;
  for (const Event &event : solution.events)
    ++counts[event.name + ", " + event.kind];
  return counts;
}

using Test = std::function<double(const Point &)>;

/// The zero of a test function between two points, by regula falsi in the arclength from the first.
bool locate(BranchFollower &follower, const Point &a, const Point &b, const Test &test, Detail detail,
            double resolution, Point &found)
{
  Point         low = a, high = b;
  const double  ds    = follower.arclength(a, b);
  double        s_low = 0., s_high = ds, f_low = test(a), f_high = test(b), last = a.lambda;
  int           side          = 0;
  constexpr int most_searches = 40; // bisection alone gets to 2^-40 of a step
  for (int k = 0; k < most_searches; ++k)
  {
    double s = f_high != f_low ? (s_low * f_high - s_high * f_low) / (f_high - f_low) : 0.5 * (s_low + s_high);
    if (k % 6 == 5 || !(s > std::min(s_low, s_high)) || !(s < std::max(s_low, s_high)))
      s = 0.5 * (s_low + s_high);
    if (!follower.between(a.tangent, low, high, (s - s_low) / (s_high - s_low), detail, found))
      return false;
    const double f = test(found);
    if (f == 0. || (std::abs(found.lambda - last) <= resolution && k > 1 && std::abs(s_high - s_low) < 1e-3 * ds))
      return true;
    if (std::abs(s_high - s_low) < 1e-9 * ds)
      return true;
    last = found.lambda;
    if ((f < 0.) == (f_low < 0.))
    {
      low = found, s_low = s, f_low = f;
      if (side == -1)
        f_high *= 0.5;
      side = -1;
    }
    else
    {
      high = found, s_high = s, f_high = f;
      if (side == 1)
        f_low *= 0.5;
      side = 1;
    }
  }
  return true;
}

/// A branch under way.
class Tracker
{
public:
  Tracker(BranchFollower &follower, const ContinuationOptions &options, const BranchProgress &progress, bool new_branch)
      : follower_(follower), options_(options), progress_(progress), new_branch_(new_branch),
        range_(options.to - options.from)
  {
  }

  /// The branch from a point on, which is its first one unless the branch is new.  A failure ends it, with the reason
  /// in `ended`.
  Branch follow(Point here);

private:
  bool next_point(const Point &here, Point &next);
  bool end_at(const Point &here, const Point &beyond);
  /// With the unknowns that fit it; where it does not close in them, it is kept before that ends the branch.
  void fit(Point &point)
  {
    const Point as_found = point;
    try
    {
      follower_.refit(point);
    }
    catch (const std::exception &)
    {
      add(as_found);
      throw;
    }
  }
  bool add(const Point &point)
  {
    branch_.points.push_back({point.lambda, point.solution});
    return !progress_ || progress_(branch_.points.back());
  }
  bool look(const std::string &kind, const Point &a, const Point &b, const Test &test, Detail detail = Detail::all);
  void note_special(const Point &a, const Point &b);

  BranchFollower            &follower_;
  const ContinuationOptions &options_;
  const BranchProgress      &progress_;
  bool                       new_branch_;
  double                     range_, wanted_ = 1. / options_.points, ds_ = wanted_;
  Branch                     branch_;
};

bool Tracker::look(const std::string &kind, const Point &a, const Point &b, const Test &test, Detail detail)
{
  if (!((test(a) < 0.) != (test(b) < 0.)))
    return false;
  Point found;
  if (locate(follower_, a, b, test, detail, options_.located * std::abs(range_), found))
  {
    const int  last = std::max(0, int(branch_.points.size()) - 1); // a is the last point so far, b the next one
    const bool past = follower_.arclength(a, found) > 0.5 * follower_.arclength(a, b);
    branch_.special.push_back({kind, found.lambda, found.solution, past ? last + 1 : last});
  }
  return true;
}

void Tracker::note_special(const Point &a, const Point &b)
{
  const bool fold = look("fold", a, b, slope_of);
  if (!fold && look("branch", a, b, [](const Point &p) { return p.regular; }) && new_branch_)
    branch_.ended = "it returns to the branch that it left";
  if (a.solution.multipliers.size() == b.solution.multipliers.size() && a.solution.stability_is_known())
  {
    look("period doubling", a, b, [](const Point &p) { return product(p.solution, -1.); });
    if (largest_pair(a.solution) > -1. && largest_pair(b.solution) > -1.)
      look("Neimark-Sacker", a, b, [](const Point &p) { return largest_pair(p.solution); });
  }
  if (const auto before = signature(a.solution); before != signature(b.solution))
    look(
        "grazing", a, b, [&](const Point &p) { return signature(p.solution) == before ? -1. : 1.; }, Detail::motion);
}

/// The next point; false: there is none however short the step.
bool Tracker::next_point(const Point &here, Point &next)
{
  constexpr double least_part = 1e-5; // of the step that is asked for: some seventeen halvings
  for (; ds_ >= least_part * wanted_; ds_ *= 0.5)
    try
    {
      constexpr double straight = 0.94; // cosine between two tangents: 20 degrees
      constexpr double corner   = 0.02; // step, of the one asked for, below which a turn is a corner
      // Where an event begins, the branch has a corner: then its tangents differ however short the step.
      if (follower_.beyond(here, ds_, next) && (next.tangent.dot(here.tangent) > straight || ds_ < corner * wanted_))
        return true;
    }
    catch (const ConvergenceFailure &)
    {
    }
  return false;
}

/// The point at the end of the parameter that lies before the one beyond; false: it was not found.
bool Tracker::end_at(const Point &here, const Point &beyond)
{
  const bool   back = (beyond.lambda - options_.from) / range_ < 0.;
  const double end  = back ? options_.from : options_.to;
  const double part = (end - here.lambda) / (beyond.lambda - here.lambda);
  Point        last;
  try
  {
    if (!follower_.at_parameter(here.z + part * (beyond.z - here.z), end, here, last))
      return false;
  }
  catch (const ConvergenceFailure &)
  {
    return false;
  }
  note_special(here, last);
  const Point as_found = last;
  try
  {
    follower_.refit(last, true);
  }
  catch (const ConvergenceFailure &)
  {
    last = as_found;
  }
  add(last);
  if (back)
    branch_.ended = "it returned to the first value of the parameter";
  return true;
}

Branch Tracker::follow(Point here)
{
  bool goes_on = new_branch_ || add(here);
  try
  {
    while (goes_on && branch_.ended.empty() && int(branch_.points.size()) < options_.most)
    {
      Point next;
      if (!next_point(here, next))
        throw NoPeriodicMotion("no next solution was found beyond " + std::to_string(here.lambda));
      const double share = (next.lambda - options_.from) / range_;
      if (share > 1. || share < 0.)
      {
        if (end_at(here, next))
          return branch_;
        ds_ *= 0.5;
        continue;
      }
      if (!new_branch_ || !branch_.points.empty())
        note_special(here, next);
      here = next;
      follower_.grow_size(here);
      fit(here);
      goes_on                         = add(here);
      constexpr int    few_iterations = 6;  // of a correction: a step that is too long takes more
      constexpr double widest         = 2.; // step, of the one asked for
      if (next.iterations <= few_iterations)
        ds_ = std::min(1.3 * ds_, widest * wanted_);
    }
    if (branch_.ended.empty())
    {
      std::ostringstream text;
      text << "it has " << options_.most << " points, the last at " << here.lambda;
      constexpr double short_part = 0.1; // step, of the one asked for, of a branch that hardly moves on
      if (ds_ < short_part * wanted_)
        text << ", and its steps have become short: use another method, or fewer harmonics";
      branch_.failed = goes_on;
      branch_.ended  = goes_on ? text.str() : "interrupted";
    }
  }
  catch (const std::exception &failure)
  {
    branch_.ended  = failure.what();
    branch_.failed = true;
  }
  return branch_;
}

/// The motion that dF/dz leaves free [m].
VectorXd null_vector(const MatrixXd &J)
{
  return SymmetricEigenSolver(J.transpose() * J).eigenvectors().col(0);
}

} // namespace

Branch follow_branch(BranchEquations &equations, const PeriodicSolution &first, const ContinuationOptions &options,
                     const BranchProgress &progress)
{
  BranchFollower follower(equations, options.to - options.from, options.tolerance);
  const VectorXd z = equations.unknowns(first, options.from);
  Point          here;
  here.z       = z;
  here.tangent = VectorXd::Zero(z.size() + 1);
  follower.grow_size(here);
  here.tangent[z.size()] = 1.;
  if (!follower.at_parameter(z, options.from, Point(here), here))
    throw NoPeriodicMotion(
        "the branch does not begin: Newton's method does not converge at the first value of the parameter");
  follower.size_from_rest(here);
  return Tracker(follower, options, progress, false).follow(here);
}

Branch follow_new_branch(BranchEquations &equations, const SpecialMotion &from, const ContinuationOptions &options,
                         const BranchProgress &progress, Side side)
{
  BranchFollower follower(equations, options.to - options.from, options.tolerance);
  Point          here;
  here.z        = equations.unknowns(from.solution, from.parameter);
  here.lambda   = from.parameter;
  here.solution = from.solution;
  here.tangent  = VectorXd::Zero(here.z.size() + 1);
  follower.grow_size(here);
  equations.evaluate(here.z, here.lambda, true);
  here.tangent.head(here.z.size()) = (side == Side::along ? 1. : -1.) * null_vector(equations.jacobian());
  return Tracker(follower, options, progress, true).follow(here);
}

namespace
{

/// Whether a motion has an image on a branch: another motion there, at the same parameter, with its period and
/// multipliers.  Symmetries of the machine make such images.
bool has_image(BranchEquations &equations, const BranchPoint &motion, const Branch &branch,
               const ContinuationOptions &options)
{
  if (branch.points.empty())
    return false;
  const auto near =
      std::min_element(branch.points.begin(), branch.points.end(),
                       [&](const BranchPoint &a, const BranchPoint &b)
                       { return std::abs(a.parameter - motion.parameter) < std::abs(b.parameter - motion.parameter); });
  const VectorXd z      = equations.unknowns(motion.solution, motion.parameter),
                 nearby = equations.unknowns(near->solution, near->parameter);
  BranchFollower follower(equations, options.to - options.from, options.tolerance);
  Point          start, there;
  start.tangent = VectorXd::Zero(z.size() + 1);
  try
  {
    if (!follower.at_parameter(nearby, motion.parameter, start, there))
      return false;
  }
  catch (const ConvergenceFailure &)
  {
    return false;
  }
  const auto      &mu = motion.solution.multipliers, &image_mu = there.solution.multipliers;
  constexpr double equal_images = 1e-5; // multipliers of motions that are images of each other, of the largest
  return (there.z - nearby).norm() < (there.z - z).norm() && mu.size() == image_mu.size() && mu.size() > 0 &&
         std::abs(there.solution.period - motion.solution.period) < equal_images * motion.solution.period &&
         (mu - image_mu).cwiseAbs().maxCoeff() < equal_images * mu.cwiseAbs().maxCoeff();
}

} // namespace

std::vector<Branch> follow_new_branches(BranchEquations &equations, const SpecialMotion &from,
                                        const ContinuationOptions &options, const BranchProgress &progress)
{
  std::vector<Branch> sides = {follow_new_branch(equations, from, options, progress, Side::along)};
  if (from.kind != "branch")
    return sides;
  ContinuationOptions few = options;
  few.most                = 2;
  const Branch begin      = follow_new_branch(equations, from, few, {}, Side::against);
  if (begin.points.empty() || has_image(equations, begin.points.back(), sides.front(), options))
    return sides;
  sides.push_back(follow_new_branch(equations, from, options, progress, Side::against));
  return sides;
}

} // namespace gestell::coupling
