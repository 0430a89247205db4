#pragma once

#include <optional>

namespace gestell::apps
{

/**
 * Effect of the mean stress: the range at the ratio R of the S-N curve that does the damage of a cycle (range, mean).
 *
 *   none     range
 *   goodman  amplitude a at R = -1:  a = a_cycle / (1 - mean / R_m), mean > 0; compression is no gain.
 *            A mean of R_m or more: infinite.
 *   fkm      lines of the Haigh diagram, s = mean / amplitude (FKM guideline, four fields of R):
 *              s < -1       (R > 1)           a = a_cycle (1 - M)
 *              -1 <= s <= 1 (-inf < R <= 0)   a = a_cycle (1 + M s)
 *              1 < s < 3    (0 < R < 0.5)     a = a_cycle (1 + M) (1 + s M/3) / (1 + M/3)
 *              3 <= s       (R >= 0.5)        a = a_cycle (1 + M)^2 / (1 + M/3)
 *   eurocode  tensile part + 0.6 compressive part of the range (EN 1993-1-9, 7.2.1: unwelded or stress-relieved)
 * From R = -1 to that of the curve by the inverse of the same rule; eurocode is without R.  The sign of a shear stress
 * is arbitrary, so that its mean counts by its size.
 */
struct MeanStress
{
  enum class Rule
  {
    none,
    goodman,
    fkm,
    eurocode
  };
  Rule   rule             = Rule::none;
  double tensile_strength = 0.;    ///< R_m [Pa], > 0 (goodman)
  double sensitivity      = 0.;    ///< M, 0 <= M < 1 (fkm)
  bool   shear            = false; ///< not with goodman

  /// @param ratio  R of the curve, < 1; none: the mean has no effect
  double equivalent_range(double range, double mean, std::optional<double> ratio) const;

  /// Mean with which a range is its own equivalent.
  double neutral_mean(double range, std::optional<double> ratio) const;

  /// Upper bound of equivalent_range / range over all cycles with means <= `largest_mean`; may be infinite.
  double largest_factor(double largest_mean, std::optional<double> ratio) const;
};

/// @throws std::invalid_argument: R_m, M or ratio outside of their ranges
void require_valid(const MeanStress &effect, std::optional<double> ratio);

} // namespace gestell::apps
