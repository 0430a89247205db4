#pragma once

namespace gestell::coupling
{

class StateArchive;

/// What integrators have besides whose motion can go on in another process.
class Resumable
{
public:
  virtual ~Resumable() = default;

  /// All that the steps to come depend on.  Read behind begin() of the same system with the same options, when the
  /// history of its elements is restored, the motion goes on as that which was written, to the last bit (many joints,
  /// solved sparse: to rounding).
  virtual void exchange(StateArchive &archive) = 0;
};

} // namespace gestell::coupling
