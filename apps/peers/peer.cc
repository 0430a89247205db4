#include "apps/peers/peer.h"

#include <time.h>

namespace gestell::peers
{

double thread_seconds()
{
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

std::string peer_name(const PeerOptions &options)
{
  const std::string native = options.vectors == PeerVectors::native ? ", native vectors" : "";
  const std::string order  = std::to_string(options.order);
  if (options.kind == PeerKind::explicit_rk)
    return "ARKODE explicit " + order + native;
  if (options.kind == PeerKind::petsc_bdf)
    return "PETSc BDF " + order + ", condensed";
  if (options.kind == PeerKind::petsc_alpha)
    return "PETSc alpha2 0.8, condensed";
  const std::string solver = options.solver == PeerSolver::condensed ? ", condensed" : ", dense";
  return (options.kind == PeerKind::ida           ? "IDA "
          : options.kind == PeerKind::cvode_adams ? "CVODE Adams "
                                                  : "CVODE BDF ") +
         order + solver + native;
}

} // namespace gestell::peers
