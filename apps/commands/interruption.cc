#include "apps/commands/interruption.h"

#include <csignal>
#include <unistd.h>

namespace gestell::apps
{

namespace
{
std::atomic<bool> interrupted{false};

extern "C" void note_interruption(int signal_number)
{
  constexpr char message[] = "\ngestell: interrupted; saving what was computed (once more: end at once)\n";
  interrupted.store(true);
  if (write(STDERR_FILENO, message, sizeof message - 1) < 0) // nothing more can be done in a signal handler
    return;
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
