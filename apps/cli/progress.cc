#include "apps/cli/progress.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <unistd.h>

namespace gestell::apps
{

std::string duration_text(double seconds)
{
  const long s = std::max(0L, std::lround(seconds));
  if (s < 100)
    return std::to_string(s) + " s";
  if (s < 100 * 60)
    return std::to_string((s + 30) / 60) + " min";
  return std::to_string((s + 1800) / 3600) + " h";
}

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
  if (new_phase)
  {
    begin_       = now;
    first_share_ = std::max(share, 0.);
  }
  if (!drawn_ || (!new_phase && now - last_drawn_ < std::chrono::milliseconds(80)))
    return;
  last_drawn_ = now;
  if (share < 0.)
    std::fprintf(stderr, "\r\033[K%s ...%s", phase.c_str(), times(share).c_str());
  else
  {
    constexpr int width  = 24; // letters of a bar: 4 % each
    const int     filled = std::clamp(static_cast<int>(share * width), 0, width);
    std::fprintf(stderr, "\r\033[K%s [%s%s] %3.0f %%%s", phase.c_str(), std::string(filled, '#').c_str(),
                 std::string(width - filled, '.').c_str(), 100. * share, times(share).c_str());
  }
  std::fflush(stderr);
}

/// "  12 s, about 3 min left": at the present rate of the phase; no estimate if it is too early, or without a share.
std::string ProgressLine::times(double share) const
{
  const double     passed    = std::chrono::duration<double>(Clock::now() - begin_).count();
  constexpr double told_from = 2.; // [s] of a phase: shorter ones end before they are read
  if (passed < told_from)
    return "";
  const std::string text        = "  " + duration_text(passed);
  const double      gone        = share - first_share_;
  constexpr double  least_share = 0.01; // of a phase: less does not show its rate
  return gone < least_share ? text : text + ", about " + duration_text(passed * (1. - share) / gone) + " left";
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
