#include "fem/petsc_session.h"

#include <slepcsys.h>

#include <stdexcept>

namespace gestell::fem
{

namespace
{

class Session
{
public:
  Session()
  {
    // The computer's own signal handling stays: a segmentation fault must not be turned into a page of PETSc text.
    static char  name[]    = "gestell";
    static char  option[]  = "-no_signal_handler";
    static char *words[]   = {name, option, nullptr};
    char       **arguments = words;
    int          count     = 2;
    if (SlepcInitialize(&count, &arguments, nullptr, nullptr) != 0)
      throw std::runtime_error("petsc_session: SLEPc could not be started; check the installation of libslepc-real.");
  }

  ~Session()
  {
    // MPI may have been ended before by its other users; PETSc must not be touched after that.
    int ended = 0;
    MPI_Finalized(&ended);
    if (!ended)
      SlepcFinalize();
  }

  Session(const Session &)            = delete;
  Session &operator=(const Session &) = delete;
};

} // namespace

void petsc_session() { static const Session session; }

} // namespace gestell::fem
