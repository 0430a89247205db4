// Builds without SUNDIALS.

#include "apps/peers/peer.h"

#include <stdexcept>

namespace gestell::peers
{

bool peers_available()
{
  return false;
}

bool petsc_available()
{
  return false;
}

std::string peer_version()
{
  return "";
}

PeerResult run_peer(coupling::SecondOrderSystem &, const PeerProblem &, const PeerOptions &)
{
  throw std::invalid_argument("peers: this build has no SUNDIALS; install libsundials-dev and configure it again with "
                              "GESTELL_PEERS=ON.");
}

} // namespace gestell::peers
