#pragma once

#include <slepceps.h>

#include <memory>
#include <string>
#include <type_traits>

namespace gestell::coupling
{

/// PETSc objects that destroy themselves: collectively, if they belong to several ranks.
struct DestroyPetsc
{
  void operator()(Mat x) const { MatDestroy(&x); }
  void operator()(Vec x) const { VecDestroy(&x); }
  void operator()(VecScatter x) const { VecScatterDestroy(&x); }
  void operator()(IS x) const { ISDestroy(&x); }
  void operator()(EPS x) const { EPSDestroy(&x); }
  void operator()(KSP x) const { KSPDestroy(&x); }
};
template <typename T>
using PetscOwned = std::unique_ptr<std::remove_pointer_t<T>, DestroyPetsc>;

/// During its lifetime PETSc returns its errors and prints nothing; the innermost message is stored.
class QuietPetsc
{
public:
  QuietPetsc() { PetscPushErrorHandler(keep, nullptr); }
  ~QuietPetsc() { PetscPopErrorHandler(); }
  QuietPetsc(const QuietPetsc &)            = delete;
  QuietPetsc &operator=(const QuietPetsc &) = delete;

  static std::string &message()
  {
    static std::string text;
    return text;
  }

private:
  static PetscErrorCode keep(MPI_Comm, int, const char *, const char *, PetscErrorCode code, PetscErrorType type,
                             const char *text, void *)
  {
    if (type == PETSC_ERROR_INITIAL)
      message() = text ? text : "";
    return code;
  }
};

inline void require_petsc(PetscErrorCode code, const char *what)
{
  if (code == 0)
    return;
  const char *text = nullptr;
  PetscErrorMessage(code, &text, nullptr);
  throw std::runtime_error(std::string(what) + ": PETSc failed with error " + std::to_string(code) +
                           (text ? std::string(": ") + text : std::string()));
}

} // namespace gestell::coupling
