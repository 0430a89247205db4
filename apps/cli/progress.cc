#include "apps/cli/progress.h"

#include <algorithm>
#include <cstdio>
#include <unistd.h>

namespace gestell::apps
{

ProgressLine::ProgressLine(bool quiet) : drawn_(!quiet && isatty(STDERR_FILENO)), begin_(Clock::now()) {}

ProgressLine::~ProgressLine()
{
  done();
}

void ProgressLine::end_phase()
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

void ProgressLine::show(const std::string &phase, double share)
{
  const auto now       = Clock::now();
  const bool new_phase = phase != phase_;
  if (new_phase)
  {
    end_phase();
    phase_ = phase;
    begin_ = now;
  }
  if (!drawn_ || (!new_phase && now - last_drawn_ < std::chrono::milliseconds(80)))
    return;
  last_drawn_ = now;
  if (share < 0.)
    std::fprintf(stderr, "\r\033[K%s ...", phase.c_str());
  else
  {
    constexpr int width  = 24;
    const int     filled = std::clamp(static_cast<int>(share * width), 0, width);
    std::fprintf(stderr, "\r\033[K%s [%s%s] %3.0f %%", phase.c_str(), std::string(filled, '#').c_str(),
                 std::string(width - filled, '.').c_str(), 100. * share);
  }
  std::fflush(stderr);
}

void ProgressLine::done()
{
  end_phase();
  if (drawn_)
    std::fprintf(stderr, "\r\033[K");
}

} // namespace gestell::apps
