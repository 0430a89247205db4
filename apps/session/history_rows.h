#pragma once

#include "coupling/simulation/run_result.h"

#include <algorithm>
#include <limits>
#include <string>

namespace gestell::apps
{

/// Access to the rows of the history.
class HistoryRows
{
public:
  /// @param from  [s] time of the first row that is used
  explicit HistoryRows(const coupling::RunResult &run, double from = -std::numeric_limits<double>::infinity())
      : run_(run), width_(run.columns.size()), n_(width_ > 0 ? run.rows.size() / width_ : 0)
  {
    while (first_ < n_ && t(0) < from)
      ++first_;
  }

  std::size_t size() const { return n_ - first_; }
  double      t(std::size_t i) const { return at(i, 0); }
  double      at(std::size_t i, std::size_t column) const { return run_.rows[(first_ + i) * width_ + column]; }
  /// @return 0, the column of the time, if there is no such column
  std::size_t column(const std::string &name) const
  {
    const auto found = std::find(run_.columns.begin(), run_.columns.end(), name);
    return found == run_.columns.end() ? 0 : std::size_t(found - run_.columns.begin());
  }
  const std::string &unit(std::size_t column) const { return run_.units[column]; }

private:
  const coupling::RunResult &run_;
  std::size_t                width_, n_, first_ = 0;
};

} // namespace gestell::apps
