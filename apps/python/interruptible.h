#pragma once

#include <atomic>

namespace gestell::python
{

/// During its lifetime Ctrl-C ends runs instead of raising KeyboardInterrupt after them; afterwards the handler of
/// Python is restored.  Constructor and destructor need the interpreter lock.
class Interruptible
{
public:
  Interruptible();
  ~Interruptible();
  Interruptible(const Interruptible &) = delete;

  const std::atomic<bool> &requested() const;
};

} // namespace gestell::python
