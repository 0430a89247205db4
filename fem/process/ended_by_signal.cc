#include "fem/process/ended_by_signal.h"

#include <csignal>

namespace gestell::fem
{

namespace
{

constexpr int ending[] = {SIGINT, SIGTERM, SIGHUP};

volatile std::sig_atomic_t noted = 0; ///< the signal

extern "C" void note_ending(int number)
{
  noted = number;
}

} // namespace

EndedBySignal::EndedBySignal()
{
  for (int i = 0; i < n_signals; ++i)
  {
    struct sigaction now = {}, note = {};
    note.sa_handler = note_ending;
    ours_[i] = sigaction(ending[i], nullptr, &now) == 0 && !(now.sa_flags & SA_SIGINFO) && now.sa_handler == SIG_DFL &&
               sigaction(ending[i], &note, nullptr) == 0;
  }
}

EndedBySignal::~EndedBySignal()
{
  for (int i = 0; i < n_signals; ++i)
    if (ours_[i])
      std::signal(ending[i], SIG_DFL);
  if (const int number = noted)
  {
    noted = 0;
    raise(number);
  }
}

bool EndedBySignal::requested() const
{
  return noted != 0;
}

} // namespace gestell::fem
