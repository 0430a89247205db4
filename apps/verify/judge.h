#pragma once

#include "apps/verify/reference_case.h"

#include <atomic>

namespace gestell::apps
{

/// A check with what came out.
struct CheckOutcome
{
  std::string expected{}, obtained{}; ///< numbers; of rows those that differ most
  int         n_numbers = 0;          ///< compared
  int         n_words   = 0;          ///< compared, all of them the same
  int         n_left    = 0;          ///< expected cells without a value
  double      error = 0., allowed = 0.;
  bool        passed = false;
  std::string failure{}; ///< why there is nothing to compare
};

struct CaseOutcome
{
  std::vector<CheckOutcome> checks{}; ///< one a check
  double                    cpu_s = 0.;

  bool passed() const;
};

/// Computes a case and judges it; a computation that fails, fails its checks.
/// @throws std::invalid_argument with its place for a case that says what there is not
CaseOutcome judged(const ReferenceCase &one, const std::atomic<bool> *interruption);

} // namespace gestell::apps
