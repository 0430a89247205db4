#include "apps/analysis/comparison/run_comparison.h"

namespace gestell::apps
{

std::vector<SharedSignal> shared_signals(const coupling::RunResult &a, const coupling::RunResult &b)
{
  std::vector<SharedSignal> shared;
  for (std::size_t i = 0; i < a.signals.size(); ++i)
    for (std::size_t j = 0; j < b.signals.size(); ++j)
      if (a.signals[i].name == b.signals[j].name && a.signals[i].unit == b.signals[j].unit)
        shared.push_back({i, j});
  return shared;
}

ComparedRun compared_run(const coupling::RunResult &run, const std::string &scene, coupling::RunResult other)
{
  ComparedRun compared{scene, std::move(other), {}};
  for (const SharedSignal shared : shared_signals(run, compared.run))
  {
    const coupling::SignalSummary &a = run.signals[shared.a], &b = compared.run.signals[shared.b];
    compared.signals.push_back({a.name, {{a.max, a.t_max, b.max, b.t_max}, {a.min, a.t_min, b.min, b.t_min}}});
  }
  return compared;
}

} // namespace gestell::apps
