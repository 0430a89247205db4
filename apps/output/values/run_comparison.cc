#include "apps/output/values/run_comparison.h"

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

} // namespace gestell::apps
