#pragma once

#include <atomic>

namespace gestell::python
{

/// While one lives Ctrl-C ends runs instead of raising KeyboardInterrupt when they are done; afterwards Python has it
/// back.  Needs the lock of the interpreter at both ends of its life.
class Interruptible
{
public:
  Interruptible();
  ~Interruptible();
  Interruptible(const Interruptible &) = delete;

  const std::atomic<bool> &requested() const;
};

} // namespace gestell::python
