#include "coupling/eigensolvers/blas_threads.h"

#include "coupling/algebra/openblas.h"

#include <dlfcn.h>

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>

extern "C" void openblas_set_num_threads(int n);
extern "C" void dgemm_();

namespace gestell::coupling
{

void use_one_blas_thread()
{
  static const std::string library = []
  {
    Dl_info found{};
    if (!dladdr(reinterpret_cast<void *>(&dgemm_), &found) || !found.dli_fname)
      return std::string("not known");
    std::error_code error; // Debian chooses among libraries by links
    const auto      file = std::filesystem::canonical(found.dli_fname, error);
    return error ? std::string(found.dli_fname) : file.string();
  }();
  if (library.find("openblas") == std::string::npos)
    throw std::invalid_argument("reduction: BLAS is " + library +
                                ", but Gestell needs OpenBLAS; on Debian install "
                                "libopenblas0-pthread and choose it with: update-alternatives --config "
                                "libblas.so.3-x86_64-linux-gnu");
  use_fitting_blas_kernels();
  const char *wanted = std::getenv("OPENBLAS_NUM_THREADS"); // --jobs sets it
  openblas_set_num_threads(wanted && std::atoi(wanted) > 0 ? std::atoi(wanted) : 1);
}

} // namespace gestell::coupling
