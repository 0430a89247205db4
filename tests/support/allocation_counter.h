#pragma once

// Counts what a program takes from the heap, by whichever way: new, Eigen's aligned memory, C.  Include it in one
// source file of a test program; malloc and its kin are replaced by ones that count and hand on to the C library
// (glibc).

#include <cerrno>
#include <cstddef>
#include <cstdlib>

#if defined(__SANITIZE_ADDRESS__) || !defined(__GLIBC__)
#define GESTELL_COUNTS_ALLOCATIONS 0 // the sanitizer has replaced malloc already
#else
#define GESTELL_COUNTS_ALLOCATIONS 1
#endif

namespace gestell::tests
{

/// Calls so far.
inline long allocations = 0;

/// False: this build cannot count.
constexpr bool counts_allocations = GESTELL_COUNTS_ALLOCATIONS;

} // namespace gestell::tests

#if GESTELL_COUNTS_ALLOCATIONS
#pragma GCC visibility push(default) // for the libraries too
extern "C"
{
  void *__libc_malloc(std::size_t);
  void *__libc_calloc(std::size_t, std::size_t);
  void *__libc_realloc(void *, std::size_t);
  void *__libc_memalign(std::size_t, std::size_t);

  void *malloc(std::size_t size) noexcept
  {
    ++gestell::tests::allocations;
    return __libc_malloc(size);
  }
  void *calloc(std::size_t n, std::size_t size) noexcept
  {
    ++gestell::tests::allocations;
    return __libc_calloc(n, size);
  }
  void *realloc(void *old, std::size_t size) noexcept
  {
    ++gestell::tests::allocations;
    return __libc_realloc(old, size);
  }
  void *aligned_alloc(std::size_t alignment, std::size_t size) noexcept
  {
    ++gestell::tests::allocations;
    return __libc_memalign(alignment, size);
  }
  int posix_memalign(void **result, std::size_t alignment, std::size_t size) noexcept
  {
    ++gestell::tests::allocations;
    *result = __libc_memalign(alignment, size);
    return *result ? 0 : ENOMEM;
  }
}
#pragma GCC visibility pop
#endif
