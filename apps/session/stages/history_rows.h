#pragma once

#include "coupling/simulation/run_result.h"

#include <algorithm>
#include <string>

namespace gestell::apps
{

/// Rows of the history, as many as there are.
class HistoryRows
{
public:
  explicit HistoryRows(const coupling::RunResult &run) : run_(run), width_(run.columns.size()) {}

  std::size_t size() const { return width_ > 0 ? run_.rows.size() / width_ : 0; }
  double      t(std::size_t i) const { return run_.rows[i * width_]; }
  double      at(std::size_t i, std::size_t column) const { return run_.rows[i * width_ + column]; }
  /// @return 0, the time, if there is none
  std::size_t column(const std::string &name) const
  {
    const auto found = std::find(run_.columns.begin(), run_.columns.end(), name);
    return found == run_.columns.end() ? 0 : std::size_t(found - run_.columns.begin());
  }
  const std::string &unit(std::size_t column) const { return run_.units[column]; }

private:
  const coupling::RunResult &run_;
  std::size_t                width_;
};

} // namespace gestell::apps
