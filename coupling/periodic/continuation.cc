#include "coupling/periodic/continuation.h"

#include "coupling/integration/system/dense_solvers.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <map>

namespace gestell::coupling
{

namespace
{
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int    most_iterations = 12, few_iterations = 4;
constexpr double least_part    = 1e-5; ///< of the step that is asked for
constexpr double widest        = 2.;   ///< the step, of that
constexpr double straight      = 0.94; ///< cosine between two tangents: 20 degrees
constexpr double difference    = 1e-6; ///< of the range, for dF/dlambda
constexpr double corner        = 0.02; ///< step, of that, below which a turn is a corner
constexpr double slow          = 0.3;  ///< contraction above which the matrix is taken anew
constexpr int    most_searches = 40;

/// A point of the branch with what the next one needs.
struct Point
{
  VectorXd         z, tangent; ///< [m], [m + 1], scaled: dz/size, dlambda/range
  double           lambda = 0.;
  PeriodicSolution solution;
  double           regular    = 0.; ///< sign of det dF/dz times its least pivot
  int              iterations = 0;
};

double least_pivot(const MatrixXd &J)
{
  const Eigen::PartialPivLU<MatrixXd> lu(J);
  double                              sign = lu.permutationP().determinant(), least = 1e300;
  for (Index i = 0; i < J.rows(); ++i)
  {
    const double pivot = lu.matrixLU()(i, i);
    sign *= pivot < 0. ? -1. : 1.;
    least = std::min(least, std::abs(pivot));
  }
  return sign * least;
}

class Follower
{
public:
  Follower(BranchEquations &equations, const ContinuationOptions &options)
      : equations_(equations), options_(options), range_(options.to - options.from)
  {
  }

  /// The point at fixed lambda nearest to z, with the tangent that goes on along `ahead`.
  bool at_parameter(const VectorXd &z, double lambda, const VectorXd &ahead, Point &point);
  /// The point a step along the tangent of another.
  bool beyond(const Point &from, double ds, Point &point);

  /// Lengths of z count against the largest so far; tangents of points that are there follow.
  void grow_size(Point &point);

private:
  bool     correct(VectorXd z, double lambda, const VectorXd &across, Point &point);
  bool     finish(const VectorXd &z, double lambda, const VectorXd &ahead, Point &point);
  MatrixXd bordered(const VectorXd &last) const;

  BranchEquations           &equations_;
  const ContinuationOptions &options_;
  double                     range_, size_ = 1e-300;
  VectorXd                   slope_; ///< dF/dlambda
};

void Follower::grow_size(Point &point)
{
  const double norm = point.z.norm();
  if (!(norm > size_))
    return;
  if (size_ > 0.)
  {
    point.tangent.head(point.z.size()) *= size_ / norm;
    point.tangent.normalize();
  }
  size_ = norm;
}

/// [F_z size, F_lambda range; last^T]
MatrixXd Follower::bordered(const VectorXd &last) const
{
  const Index m = last.size() - 1;
  MatrixXd    A(m + 1, m + 1);
  A.topLeftCorner(m, m)  = equations_.jacobian() * size_;
  A.topRightCorner(m, 1) = slope_ * range_;
  A.bottomRows(1)        = last.transpose();
  return A;
}

/// Newton's method across `across`, the matrix kept while it contracts well.
bool Follower::correct(VectorXd z, double lambda, const VectorXd &across, Point &point)
{
  Eigen::PartialPivLU<MatrixXd> lu;
  const Index                   m      = z.size();
  double                        before = 0.;
  bool                          fresh  = true;
  for (point.iterations = 0; point.iterations < most_iterations; ++point.iterations)
  {
    equations_.evaluate(z, lambda, fresh);
    const VectorXd F    = equations_.residual();
    const double   here = equations_.closing();
    if (!F.allFinite())
      return false;
    if (here <= options_.tolerance)
      return finish(z, lambda, across, point);
    if (fresh)
    {
      equations_.evaluate(z, lambda + difference * range_, false);
      slope_ = (equations_.residual() - F) / (difference * range_);
      equations_.evaluate(z, lambda, true);
      lu.compute(bordered(across));
    }
    VectorXd r        = VectorXd::Zero(m + 1);
    r.head(m)         = -F;
    const VectorXd dx = lu.solve(r);
    if (!dx.allFinite())
      return false;
    z += size_ * dx.head(m);
    lambda += range_ * dx[m];
    fresh  = point.iterations > 0 && here > slow * before;
    before = here;
  }
  return false;
}

/// Multipliers and the tangent of a point that is found.
bool Follower::finish(const VectorXd &z, double lambda, const VectorXd &ahead, Point &point)
{
  const Index m = z.size();
  equations_.evaluate(z, lambda + difference * range_, false);
  slope_ = equations_.residual();
  equations_.evaluate(z, lambda - difference * range_, false);
  slope_ = (slope_ - equations_.residual()) / (2. * difference * range_);
  equations_.evaluate(z, lambda, true);
  VectorXd last  = VectorXd::Zero(m + 1);
  last[m]        = 1.;
  point.tangent  = bordered(ahead).partialPivLu().solve(last).normalized();
  point.z        = z;
  point.lambda   = lambda;
  point.solution = equations_.solution();
  point.regular  = least_pivot(equations_.jacobian());
  return point.tangent.allFinite();
}

bool Follower::at_parameter(const VectorXd &z, double lambda, const VectorXd &ahead, Point &point)
{
  VectorXd across  = VectorXd::Zero(z.size() + 1);
  across[z.size()] = 1.;
  if (!correct(z, lambda, across, point))
    return false;
  if (point.tangent.dot(ahead) < 0.)
    point.tangent *= -1.;
  return true;
}

bool Follower::beyond(const Point &from, double ds, Point &point)
{
  const Index m = from.z.size();
  return correct(from.z + ds * size_ * from.tangent.head(m), from.lambda + ds * range_ * from.tangent[m], from.tangent,
                 point);
}

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

/// The zero of a test function between two points, by the arclength from the first.
bool locate(Follower &follower, const Point &a, double ds, const Test &test, double t_a, double t_b, double resolution,
            Point &found)
{
  double low = 0., high = ds, f_low = t_a, f_high = t_b, last = a.lambda;
  int    side = 0;
  for (int k = 0; k < most_searches; ++k)
  {
    double s = f_high != f_low ? (low * f_high - high * f_low) / (f_high - f_low) : 0.5 * (low + high);
    if (k % 6 == 5 || !(s > std::min(low, high)) || !(s < std::max(low, high)))
      s = 0.5 * (low + high);
    if (!follower.beyond(a, s, found))
      return false;
    const double f = test(found);
    if (f == 0. || (std::abs(found.lambda - last) <= resolution && k > 1 && std::abs(high - low) < 1e-3 * ds))
      return true;
    if (std::abs(high - low) < 1e-9 * ds)
      return true;
    last = found.lambda;
    if ((f < 0.) == (f_low < 0.))
    {
      low = s, f_low = f;
      if (side == -1)
        f_high *= 0.5;
      side = -1;
    }
    else
    {
      high = s, f_high = f;
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
  Tracker(Follower &follower, const ContinuationOptions &options, const BranchProgress &progress, bool new_branch)
      : follower_(follower), options_(options), progress_(progress), new_branch_(new_branch),
        range_(options.to - options.from)
  {
  }

  /// The branch from a point on, which is its first one unless the branch is new.  A failure ends it, with the reason
  /// in `ended`.
  Branch follow(Point here);

private:
  bool next_point(const Point &here, Point &next);
  void end_at(const Point &here, const Point &beyond);
  bool add(const Point &point)
  {
    branch_.points.push_back({point.lambda, point.solution});
    return !progress_ || progress_(branch_.points.back());
  }
  bool look(const std::string &kind, const Point &a, const Point &b, double ds, const Test &test);
  void note_special(const Point &a, const Point &b, double ds);

  Follower                  &follower_;
  const ContinuationOptions &options_;
  const BranchProgress      &progress_;
  bool                       new_branch_;
  double                     range_, wanted_ = 1. / options_.points, ds_ = wanted_;
  Branch                     branch_;
};

bool Tracker::look(const std::string &kind, const Point &a, const Point &b, double ds, const Test &test)
{
  const double t_a = test(a), t_b = test(b);
  if (!((t_a < 0.) != (t_b < 0.)))
    return false;
  Point found;
  if (locate(follower_, a, ds, test, t_a, t_b, options_.located * std::abs(range_), found))
    branch_.special.push_back({kind, found.lambda, found.solution});
  return true;
}

void Tracker::note_special(const Point &a, const Point &b, double ds)
{
  const bool fold = look("fold", a, b, ds, slope_of);
  if (!fold && look("branch", a, b, ds, [](const Point &p) { return p.regular; }) && new_branch_)
    branch_.ended = "it meets the branch that it left";
  if (a.solution.multipliers.size() == b.solution.multipliers.size() && a.solution.stability_is_known())
  {
    look("period doubling", a, b, ds, [](const Point &p) { return product(p.solution, -1.); });
    if (largest_pair(a.solution) > -1. && largest_pair(b.solution) > -1.)
      look("Neimark-Sacker", a, b, ds, [](const Point &p) { return largest_pair(p.solution); });
  }
  if (const auto before = signature(a.solution); before != signature(b.solution))
    look("grazing", a, b, ds, [&](const Point &p) { return signature(p.solution) == before ? -1. : 1.; });
}

/// The next point; false: there is none however short the step.
bool Tracker::next_point(const Point &here, Point &next)
{
  for (; ds_ >= least_part * wanted_; ds_ *= 0.5)
    try
    {
      // Where an event begins, the branch has a corner: then its tangents differ however short the step.
      if (follower_.beyond(here, ds_, next) && (next.tangent.dot(here.tangent) > straight || ds_ < corner * wanted_))
        return true;
    }
    catch (const ConvergenceFailure &)
    {
    }
  return false;
}

/// The point at the end of the parameter that lies before the one beyond.
void Tracker::end_at(const Point &here, const Point &beyond)
{
  const bool   back = (beyond.lambda - options_.from) / range_ < 0.;
  const double end  = back ? options_.from : options_.to;
  const double part = (end - here.lambda) / (beyond.lambda - here.lambda);
  Point        last;
  if (follower_.at_parameter(here.z + part * (beyond.z - here.z), end, here.tangent, last))
  {
    note_special(here, last, part * ds_);
    add(last);
  }
  if (back)
    branch_.ended = "it came back to the first value of the parameter";
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
        throw NoPeriodicMotion("no next motion was found beyond " + std::to_string(here.lambda));
      const double share = (next.lambda - options_.from) / range_;
      if (share > 1. || share < 0.)
      {
        end_at(here, next);
        return branch_;
      }
      if (!new_branch_ || !branch_.points.empty())
        note_special(here, next, ds_);
      here = next;
      follower_.grow_size(here);
      goes_on = add(here);
      if (next.iterations <= few_iterations)
        ds_ = std::min(1.3 * ds_, widest * wanted_);
    }
    if (branch_.ended.empty())
      branch_.ended = goes_on ? "it has " + std::to_string(options_.most) + " points" : "interrupted";
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
  Follower       follower(equations, options);
  const VectorXd z = equations.unknowns(first, options.from);
  Point          here;
  here.z       = z;
  here.tangent = VectorXd::Zero(z.size() + 1);
  follower.grow_size(here);
  VectorXd ahead  = VectorXd::Zero(z.size() + 1);
  ahead[z.size()] = 1.;
  if (!follower.at_parameter(z, options.from, ahead, here))
    throw NoPeriodicMotion("the branch does not begin: Newton's method does not close the motion at the first value of "
                           "the parameter");
  return Tracker(follower, options, progress, false).follow(here);
}

Branch follow_new_branch(BranchEquations &equations, const SpecialMotion &from, const ContinuationOptions &options,
                         const BranchProgress &progress)
{
  Follower follower(equations, options);
  Point    here;
  here.z        = equations.unknowns(from.solution, from.parameter);
  here.lambda   = from.parameter;
  here.solution = from.solution;
  here.tangent  = VectorXd::Zero(here.z.size() + 1);
  follower.grow_size(here);
  equations.evaluate(here.z, here.lambda, true);
  here.tangent.head(here.z.size()) = null_vector(equations.jacobian());
  return Tracker(follower, options, progress, true).follow(here);
}

} // namespace gestell::coupling
