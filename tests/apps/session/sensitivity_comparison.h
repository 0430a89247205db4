#pragma once

#include <string>
#include <vector>

namespace gestell::tests
{

/// A shipped scene, shortened where it is long, and how its derivatives are compared with differences of runs.
struct ComparedScene
{
  std::string              scene;
  std::vector<std::string> overrides;   ///< by which its runs converge
  double                   h;           ///< share of a value, the smallest difference
  std::size_t              n_keys;      ///< entries, drawn at random, by which it is differentiated
  int                      n_steps = 6; ///< differences h, 2 h, 4 h ..., at least four
};

/// Derivatives of one scene against differences.  They are compared relative to the largest value of their signal,
/// instants to the length of the run.
struct Comparison
{
  struct Side
  {
    int    converged = 0, within = 0;
    double worst = 0.;
  };
  int                      n = 0, none = 0; ///< of all, and of those without a derivative
  Side                     smooth, events;  ///< of the motion before the first event, and behind it
  std::vector<std::string> beyond;          ///< those that are off by more than the limit
  std::vector<std::string> missing; ///< no derivative, though their differences converge to another value than 0
};

constexpr double limit_smooth = 1e-6, limit_events = 1e-4;

/**
 * Derivatives of a scene by entries drawn at random, of as many units as there are, against central differences of its
 * runs over h, 2 h, 4 h ..., extrapolated to order 6.  What neighbours of these differ by is the error of a
 * difference, of truncation or of rounding of the runs; those known to a tenth of the limit count.
 *
 * Prints the row of the table in docs/theory/sensitivities.md, and what is off.
 */
Comparison compared_with_differences(const ComparedScene &compared);

} // namespace gestell::tests
