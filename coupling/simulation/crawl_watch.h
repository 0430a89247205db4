#pragma once

#include "coupling/integration/system/convergence_failure.h"
#include "coupling/simulation/run_result.h"

#include <algorithm>
#include <sstream>

namespace gestell::coupling
{

constexpr double most_steps = 1e10; ///< of a run

/// Ends a run whose controlled steps have become so short that it would never end.
class CrawlWatch
{
public:
  explicit CrawlWatch(const RunOptions &options) : options_(options), from_(options.begin) {}

  /// @throws ConvergenceFailure if the rest of the run would need more than `most_steps` at the pace of the last ones.
  void look(double t)
  {
    const double steps = window * (options_.end - t) / std::max(t - from_, 1e-300);
    if (steps > most_steps)
    {
      std::ostringstream text;
      text << "controlled steps have become too short to reach the end: " << window << " steps from t = " << from_
           << " s took " << t - from_ << " s, and at this pace the rest would need " << steps
           << "; take a larger run.tolerance";
      throw ConvergenceFailure(text.str());
    }
    from_ = t;
  }

  template <typename Archive>
  void exchange(Archive &archive)
  {
    archive(from_);
  }

  static constexpr long window = 1L << 15;

private:
  const RunOptions &options_;
  double            from_;
};

} // namespace gestell::coupling
