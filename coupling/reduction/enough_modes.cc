#include "coupling/reduction/enough_modes.h"

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

std::string percent(double x)
{
  std::ostringstream out;
  out.precision(3);
  out << 100. * x << " %";
  return out.str();
}

} // namespace

SupportedModes enough_modes(ReductionBasis &basis, FixedModes &fixed, const InteriorResponse &response,
                            const fem::FrameMatrices &frame, const ReductionOptions &options, const Progress &progress,
                            std::vector<std::string> &notes)
{
  const int n2 = int(frame.M.rows()) - basis.n1(), most = std::min(n2, most_modes);
  for (int m = std::min(first_modes, most);; m = std::min(most, int(std::ceil(growth * m))))
  {
    if (progress)
      progress("fixed-interface modes", double(m) / most);
    const LowestModes modes = fixed.lowest(m);
    basis.set_modes(frame.M, modes.V, modes.omega);
    if (progress)
      progress("error estimate", -1.);
    const ReducedMatrices star    = reduced_matrices(basis, frame.B, frame.C);
    SupportedModes        refined = supported_modes(basis, star, response);
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
