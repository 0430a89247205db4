#pragma once

#include "apps/output/describe/described.h"
#include "coupling/simulation/run_result.h"

#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace gestell::apps
{

/// An extreme of a signal in both runs.
struct ComparedExtreme
{
  double value, t, other, other_t;

  double ratio() const { return value != 0. ? other / value : std::numeric_limits<double>::quiet_NaN(); }
};

template <class Visitor>
void describe(Visitor &v, const ComparedExtreme &x)
{
  v("value", x.value, "", "in this run");
  v("t", x.t, "s", "its time");
  v("other", x.other, "", "in the other run");
  v("other_t", x.other_t, "s", "its time");
  v("ratio", x.ratio(), "1", "ratio of the other value to this one");
}

/// A signal in both runs.
struct ComparedSignal
{
  ComparedExtreme max, min;
};

template <class Visitor>
void describe(Visitor &v, const ComparedSignal &x)
{
  v("max", x.max, "", "largest value");
  v("min", x.min, "", "smallest value");
}

/// A signal common to both runs, with its index in each.
struct SharedSignal
{
  std::size_t a, b;
};

/// Signals of the same name and unit, in the order of the first run.
std::vector<SharedSignal> shared_signals(const coupling::RunResult &a, const coupling::RunResult &b);

/// Comparison of a run with that of another scene.
struct ComparedRun
{
  std::string                                         scene; ///< its name
  coupling::RunResult                                 run;
  std::vector<std::pair<std::string, ComparedSignal>> signals; ///< common to both
};

template <class Visitor>
void describe(Visitor &v, const ComparedRun &x)
{
  v("other", x.scene, "", "name of the other scene");
  v("signals", x.signals, "", "signals that both have");
}

template <class Visitor>
void describe_answer(Visitor &v, const ComparedRun &x)
{
  v.maybe(true, "compared_run", x, "", "extremes compared with those of another scene, `run --compare`");
}

/// @param scene  name of the other scene
ComparedRun compared_run(const coupling::RunResult &run, const std::string &scene, coupling::RunResult other);

} // namespace gestell::apps
