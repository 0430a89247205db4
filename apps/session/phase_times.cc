#include "apps/session/phase_times.h"

#include <algorithm>

namespace gestell::apps
{

void PhaseTimes::begin(const std::string &phase)
{
  if (phase == phase_)
    return;
  end();
  phase_ = phase;
  begin_ = Clock::now();
}

void PhaseTimes::end()
{
  if (phase_.empty())
    return;
  const double seconds = std::chrono::duration<double>(Clock::now() - begin_).count();
  const auto   known   = std::find_if(phases_.begin(), phases_.end(), [&](const auto &p) { return p.first == phase_; });
  if (known == phases_.end())
    phases_.emplace_back(phase_, seconds);
  else
    known->second += seconds;
  phase_.clear();
}

} // namespace gestell::apps
