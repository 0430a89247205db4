#include "coupling/algebra/openblas.h"

#include <dlfcn.h>

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>

extern "C" char *openblas_get_corename();
extern "C" void  openblas_set_num_threads(int n);

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

/// Makes OpenBLAS choose its kernels again. Libraries for a single type of processor lack the two functions.
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

/// The file that BLAS comes from.
std::string blas_library()
{
  Dl_info found{};
  if (!dladdr(dlsym(RTLD_DEFAULT, "dgemm_"), &found) || !found.dli_fname)
    return "not known";
  std::error_code error; // Debian chooses among libraries by links
  const auto      file = std::filesystem::canonical(found.dli_fname, error);
  return error ? std::string(found.dli_fname) : file.string();
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

int jobs_requested()
{
  const char *wanted = std::getenv("OPENBLAS_NUM_THREADS");
  return wanted && std::atoi(wanted) > 0 ? std::atoi(wanted) : 1;
}

void use_one_blas_thread()
{
  use_blas_threads(jobs_requested());
}

void use_blas_threads(int n)
{
  static const std::string library = blas_library();
  if (library.find("openblas") == std::string::npos)
    throw std::invalid_argument("reduction: BLAS is " + library +
                                ", but Gestell needs OpenBLAS; on Debian install libopenblas0-pthread and select it "
                                "with: update-alternatives --config "
                                "libblas.so.3-x86_64-linux-gnu");
  use_fitting_blas_kernels();
  openblas_set_num_threads(n);
}

} // namespace gestell::coupling
