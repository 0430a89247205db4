#include "apps/cli/progress.h"

#include <algorithm>
#include <cstdio>
#include <unistd.h>

namespace gestell::apps
{

ProgressLine::ProgressLine(bool quiet) : drawn_(!quiet && isatty(STDERR_FILENO)) {}

ProgressLine::~ProgressLine()
{
  done();
}

void ProgressLine::show(const std::string &phase, double share)
{
  const auto now       = Clock::now();
  const bool new_phase = phase != phase_;
  phase_               = phase;
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
  phase_.clear();
  if (drawn_)
    std::fprintf(stderr, "\r\033[K");
}

coupling::Progress ProgressLine::callback()
{
  return [this](const std::string &phase, double share) { show(phase, share); };
}

} // namespace gestell::apps
