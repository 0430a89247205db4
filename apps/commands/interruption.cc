#include "apps/commands/interruption.h"

#include <csignal>

namespace gestell::apps
{

namespace
{
std::atomic<bool> interrupted{false};

extern "C" void note_interruption(int signal_number)
{
  interrupted.store(true);
  std::signal(signal_number, SIG_DFL);
}
} // namespace

const std::atomic<bool> &interruption()
{
  static const bool installed = []
  {
    std::signal(SIGINT, note_interruption);
    std::signal(SIGTERM, note_interruption);
    return true;
  }();
  (void)installed;
  return interrupted;
}

} // namespace gestell::apps
