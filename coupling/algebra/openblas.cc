#include "coupling/algebra/openblas.h"

#include <dlfcn.h>

#include <cstdlib>
#include <string>

extern "C" char *openblas_get_corename();

namespace gestell::coupling
{

namespace
{

/// Kernels of OpenBLAS for this processor, "" if none are better than the oldest.
std::string fitting_kernels()
{
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512cd"))
    return "SkylakeX";
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
    return "Haswell";
#endif
  return "";
}

/// Has OpenBLAS choose its kernels again.  Libraries built for one processor alone lack the two functions.
void choose(const std::string &kernels)
{
  const auto forget = reinterpret_cast<void (*)()>(dlsym(RTLD_DEFAULT, "gotoblas_dynamic_quit"));
  const auto begin  = reinterpret_cast<void (*)()>(dlsym(RTLD_DEFAULT, "gotoblas_dynamic_init"));
  if (!forget || !begin)
    return;
  setenv("OPENBLAS_CORETYPE", kernels.c_str(), 1);
  forget();
  begin();
  unsetenv("OPENBLAS_CORETYPE");
}

} // namespace

void use_fitting_blas_kernels()
{
  static const bool once = []
  {
    const std::string kernels = fitting_kernels();
    if (!std::getenv("OPENBLAS_CORETYPE") && openblas_get_corename() == std::string("Prescott") && !kernels.empty())
      choose(kernels);
    return true;
  }();
  (void)once;
}

} // namespace gestell::coupling
