#pragma once

#include "apps/output/text/csv.h"
#include "apps/verify/judge.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/// A file of cases with its results, one outcome per case.
struct VerifiedFile
{
  CaseFile                 file{};
  std::vector<CaseOutcome> outcomes{};
};

/// All cases that were computed.
struct Verification
{
  std::vector<VerifiedFile> files{};
  std::string               version{}, commit{};
  int                       n_skipped = 0; ///< long cases that were not requested

  int n_cases() const;
  int n_checks() const;
  int n_failed() const; ///< checks
};

std::string verification_page(const Verification &all);     ///< HTML, self-contained
std::string verification_document(const Verification &all); ///< Markdown
CsvTable    verification_csv(const Verification &all);      ///< one row per check

/// "18 cases, 43 checks: all passed".
std::string verdict_text(const Verification &all);

/// "1.2e-9 of 1e-6" and the like, for a check.
std::string outcome_line(const Check &check, const CheckOutcome &outcome);

} // namespace gestell::apps
