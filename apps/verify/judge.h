#pragma once

#include "apps/verify/reference_case.h"

#include <atomic>

namespace gestell::apps
{

/// A check with its result.
struct CheckOutcome
{
  std::string expected{}, obtained{}; ///< numbers; for rows those with the largest difference
  int         n_numbers = 0;          ///< compared
  int         n_words   = 0;          ///< compared, all equal
  int         n_left    = 0;          ///< expected cells without a value
  double      error = 0., allowed = 0.;
  bool        passed = false;
  std::string failure{}; ///< why there is no comparison
};

struct CaseOutcome
{
  std::vector<CheckOutcome> checks{}; ///< one per check
  double                    cpu_s = 0.;

  bool passed() const;
};

/// Computes a case and evaluates its checks; if the computation fails, all checks fail.
/// @throws std::invalid_argument with the location for a case that refers to missing data
CaseOutcome judged(const ReferenceCase &one, const std::atomic<bool> *interruption);

} // namespace gestell::apps
