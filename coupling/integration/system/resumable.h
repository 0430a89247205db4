#pragma once

namespace gestell::coupling
{

class StateArchive;

/// Interface of integrators whose motion can be continued in another process.
class Resumable
{
public:
  virtual ~Resumable() = default;

  /// The complete state for later steps.  If it is read after begin() of the same system with the same options, and the
  /// history of its elements is restored, the motion continues exactly as the one that was written (with many joints,
  /// solved sparse: up to rounding).
  virtual void exchange(StateArchive &archive) = 0;
};

} // namespace gestell::coupling
