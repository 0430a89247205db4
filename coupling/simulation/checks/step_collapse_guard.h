#pragma once

#include "coupling/integration/events/run_observer.h"
#include "coupling/integration/system/convergence_failure.h"
#include "coupling/integration/system/state_archive.h"
#include "coupling/simulation/run_result.h"

#include <algorithm>
#include <sstream>

namespace gestell::coupling
{

constexpr double most_steps = 1e10; ///< in a run: hours for the smallest machine

/// Ends a run whose controlled steps have become too short: the rest would need more than `most_steps` at the present
/// step size.
class StepCollapseGuard : public RunObserver
{
public:
  StepCollapseGuard(const TimeIntegrator &integrator, const RunOptions &options)
      : integrator_(integrator), begin_(options.begin), end_(options.end), from_(options.begin)
  {
  }

  void begin() override
  {
    from_  = integrator_.time();
    steps_ = 0;
  }
  void step() override
  {
    if (++steps_ % window != 0)
      return;
    const double t = integrator_.time(), rest = t < end_ ? end_ - t : end_ - begin_; // a run may continue past its end
    const double steps = window * rest / std::max(t - from_, 1e-300);
    if (steps > most_steps)
    {
      std::ostringstream text;
      text << "controlled steps have become too short to reach the end: " << window << " steps from t = " << from_
           << " s took " << t - from_ << " s, and at this pace the rest would need " << steps
           << "; use a larger run.tolerance";
      throw ConvergenceFailure(text.str());
    }
    from_ = t;
  }

  void exchange(StateArchive &archive) override { archive(from_, steps_); }

private:
  static constexpr long window = 1L << 15;

  const TimeIntegrator &integrator_;
  double                begin_, end_, from_;
  long                  steps_ = 0;
};

} // namespace gestell::coupling
