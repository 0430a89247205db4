#include "fem/parallel/petsc_session.h"

#include <slepcsys.h>

#include <cstdlib>
#include <malloc.h>

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
    // Signals stay with the program, and no .petscrc in some working folder changes a result.
    static char  name[] = "gestell", signals[] = "-no_signal_handler", files[] = "-skip_petscrc";
    static char *words[]   = {name, signals, files, nullptr};
    char       **arguments = words;
    int          count     = 3;
    int          begun     = 0;
    MPI_Initialized(&begun);
    if (begun)
      PETSC_COMM_WORLD = MPI_COMM_SELF;      // of several ranks each starts when it comes to that
    setenv("OMPI_MCA_plm_rsh_agent", "", 0); // one process needs no ssh; MPI would exit without it
    if (SlepcInitialize(&count, &arguments, nullptr, nullptr) != 0)
      throw std::runtime_error("petsc_session: SLEPc could not be started; check the installation of libslepc-real.");

    // A network library of MPI (libucm) bids malloc never to return memory, and large matrices would stay in the
    // account of the process after their end.
    mallopt(M_MMAP_MAX, 65536);
    mallopt(M_MMAP_THRESHOLD, 4 << 20);
    mallopt(M_TRIM_THRESHOLD, 1 << 20);
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

void petsc_session()
{
  static const Session session;
}

} // namespace gestell::fem
