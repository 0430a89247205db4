#pragma once

#include "apps/output/values/result.h"
#include "apps/scene/file/parameters.h"
#include "apps/session/session.h"
#include "apps/study/runs/answer_entries.h"
#include "apps/verify/data_table.h"

namespace gestell::apps
{

/// A case that was computed once.
class CaseRun
{
public:
  /// @param more  scene keys in addition to those of the case
  /// @throws std::invalid_argument, std::runtime_error: it cannot be computed
  CaseRun(const ReferenceCase &one, const std::vector<std::string> &more, const std::atomic<bool> *interruption);

  /// A value of the answer, such as "signals.F.max", with its unit.
  AnswerValue value(const std::string &entry) const;
  /// Rows of the expected table, except those of methods that the case omits.
  DataTable expected_rows(const Check &check) const;
  /// A result file, "events" or, for integrators, the counterparts of the rows of `expected`.
  DataTable table(const std::string &name, const DataTable &expected) const;
  /// Value of a formula of the scene's parameters, in SI.
  /// @param unit  its required unit, unless it is a plain number; empty: any
  /// @throws std::invalid_argument for another unit
  double expected(const std::string &formula, const std::string &unit) const;

private:
  const ReferenceCase *case_;
  Parameters           parameters_{};
  Result               result_{};
};

} // namespace gestell::apps
