#include "apps/python/interruptible.h"

#include <csignal>

namespace gestell::python
{
namespace
{

std::atomic<bool> interrupted{false};
int               living = 0; ///< guarded by the lock of the interpreter
struct sigaction  of_python
{
};

extern "C" void note_wish(int)
{
  interrupted = true;
}

} // namespace

Interruptible::Interruptible()
{
  if (living++ > 0)
    return;
  interrupted = false;
  struct sigaction ours
  {
  };
  ours.sa_handler = note_wish;
  sigaction(SIGINT, &ours, &of_python);
}

Interruptible::~Interruptible()
{
  if (--living == 0)
    sigaction(SIGINT, &of_python, nullptr);
}

const std::atomic<bool> &Interruptible::requested() const
{
  return interrupted;
}

} // namespace gestell::python
