#include "coupling/reduction/enough_modes.h"

#include "coupling/dense_modes.h"
#include "coupling/integration/second_order_system.h"
#include "coupling/reduction/lowest_modes.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace gestell::coupling
{

namespace
{

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double two_pi          = 6.283185307179586;
constexpr int    first_modes     = 30;
constexpr int    most_modes      = 200;
constexpr double growth          = 1.5;
constexpr double reach           = 1.5; // highest fixed-interface mode over the limit, at least
constexpr double rule            = 3.5; // the book's
constexpr int    default_elastic = 12;  // modes of interest if no frequency is given
constexpr int    dense_limit     = 600; // internal coordinates that are solved densely

} // namespace

double highest_of_interest(const ReductionOptions &options, const SupportedModes &refined)
{
  if (options.frequency > 0. || refined.omega.size() == 0)
    return two_pi * options.frequency;
  return refined.omega(std::min<int>(default_elastic, refined.omega.size()) - 1);
}

namespace
{

/// Largest error of the model's frequencies whose refined value lies within the limit.
double largest_error(const FrequencyEstimate &estimate, const SupportedModes &refined, double limit)
{
  double largest = 0.;
  for (int j = 0; j < refined.omega.size() && refined.omega(j) <= limit; ++j)
  {
    if (j + refined.n_rigid >= estimate.error.size())
      return INFINITY; // the model has no such mode at all
    largest = std::max(largest, estimate.error(j + refined.n_rigid));
  }
  return largest;
}

/// Fewest modes m whose model stays within the tolerance; the error falls with m.
int smallest_number(const ReducedMatrices &star, int n1, const SupportedModes &refined, double tolerance, double limit)
{
  int low = -1, high = int(star.M.rows()) - n1; // high is good, low is not
  while (high - low > 1)
  {
    const int  middle                 = (low + high) / 2;
    const auto error                  = largest_error(frequency_estimate(star, n1, middle, refined), refined, limit);
    (error <= tolerance ? high : low) = middle;
  }
  return high;
}

/// All modes of the held frame, densely: for few coordinates, where Krylov spaces run out of room.
LowestModes dense_fixed_modes(const fem::FrameMatrices &frame, const std::vector<int> &q1, int n_modes)
{
  const int        n = int(frame.M.rows());
  std::vector<int> q2;
  for (int i = 0; i < n; ++i)
    if (!std::binary_search(q1.begin(), q1.end(), i))
      q2.push_back(i);
  const MatrixXd M = frame.M, C = frame.C;
  const auto     modes = dense_modes(C(q2, q2), M(q2, q2));
  if (modes.omega.size() < n_modes)
    throw ConvergenceFailure("fixed-interface modes: " + std::to_string(n_modes) +
                             " asked for, but the mass matrix of the "
                             "internal coordinates has rank " +
                             std::to_string(modes.omega.size()) + "; ask for fewer modes");
  LowestModes lowest{modes.omega.head(n_modes), MatrixXd::Zero(n, n_modes)};
  lowest.V(q2, Eigen::all) = modes.V.leftCols(n_modes);
  return lowest;
}

std::string percent(double x)
{
  std::ostringstream out;
  out.precision(3);
  out << 100. * x << " %";
  return out.str();
}

} // namespace

void add_fixed_modes(ReductionBasis &basis, const HeldFrame &held, const fem::FrameMatrices &frame, int n_modes)
{
  const int n2 = int(frame.M.rows()) - basis.n1(), old = basis.m();
  if (n_modes <= old)
    return;
  if (n2 <= dense_limit)
  {
    const auto modes = dense_fixed_modes(frame, basis.q1, n_modes);
    basis.append(frame.M, modes.V.rightCols(n_modes - old), modes.omega.tail(n_modes - old));
    return;
  }
  const auto modes = held.lowest_modes(n_modes - old, basis.fixed_modes());
  basis.append(frame.M, modes.V, modes.omega);
}

SupportedModes enough_modes(ReductionBasis &basis, const HeldFrame &held, const fem::FrameMatrices &frame,
                            const ReductionOptions &options, const Progress &progress, std::vector<std::string> &notes)
{
  const int n2 = int(frame.M.rows()) - basis.n1(), most = std::min(n2, most_modes);
  for (int m = std::min(first_modes, most);; m = std::min(most, int(std::ceil(growth * m))))
  {
    if (progress)
      progress("fixed-interface modes", double(m) / most);
    add_fixed_modes(basis, held, frame, m);
    if (progress)
      progress("error estimate", -1.);
    const ReducedMatrices star    = reduced_matrices(basis, frame.B, frame.C);
    SupportedModes        refined = supported_modes(held, basis, star, frame.M);
    const double          within  = highest_of_interest(options, refined);
    const double          error   = largest_error(frequency_estimate(star, basis.n1(), m, refined), refined, within);
    const double          highest = m > 0 ? basis.omega0(m - 1) : INFINITY;

    const bool good = error <= options.tolerance && (highest >= reach * within || m == n2);
    if (!good && m < most && highest < rule * within)
      continue;
    if (!good)
      notes.push_back("reduction: " + std::to_string(m) + " fixed-interface modes leave a frequency error of " +
                      percent(error) + " up to " + std::to_string(within / two_pi) + " Hz, above the tolerance of " +
                      percent(options.tolerance) + "; lower the frequency of interest or set the number of modes");
    else
      basis.truncate(smallest_number(star, basis.n1(), refined, options.tolerance, within));
    return refined;
  }
}

} // namespace gestell::coupling
