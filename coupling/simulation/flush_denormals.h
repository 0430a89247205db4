#pragma once

#ifdef __SSE2__
#include <xmmintrin.h>
#endif

namespace gestell::coupling
{

/// During its lifetime, numbers below 1e-308 are set to zero.  Motions without excitation, such as the out-of-plane
/// motion of bodies that move in a plane, decay to such numbers, with which a processor is seven times slower.
class FlushDenormals
{
public:
#ifdef __SSE2__
  FlushDenormals() : before_(_mm_getcsr())
  {
    _mm_setcsr(before_ | flush_to_zero | denormals_are_zero);
  }
  ~FlushDenormals()
  {
    _mm_setcsr(before_);
  }
#else
  FlushDenormals() = default;
#endif
  FlushDenormals(const FlushDenormals &)            = delete;
  FlushDenormals &operator=(const FlushDenormals &) = delete;

private:
#ifdef __SSE2__
  static constexpr unsigned flush_to_zero = 0x8000, denormals_are_zero = 0x0040;
  unsigned                  before_;
#endif
};

} // namespace gestell::coupling
