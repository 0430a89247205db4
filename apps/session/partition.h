#pragma once

#include "apps/scene/values/requests.h"
#include "coupling/machine/machine.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/// Why the coordinates of a reduced frame are in q1 (5.5.3/14).
struct Partition
{
  struct Row
  {
    std::string              coordinate; ///< "frame.crown.uz"
    std::vector<std::string> reasons;    ///< "nonlinear: rod"; none: nothing of the scene acts on it or reads it
  };
  struct Idle
  {
    std::string interface;
    int         coordinates = 0;
  };

  std::vector<Row>         rows;
  std::vector<Idle>        superfluous; ///< interfaces without a reason
  std::vector<std::string> only_read;   ///< those that signals read and nothing acts on
  int                      n2      = 0; ///< coordinates of the inside, of the unreduced frame
  int                      n_modes = 0;
  int                      n_free  = 0; ///< motions of the frame without stiffness, which its held interface stops
  int n_held_by_acted              = 0; ///< of these, by coordinates that something acts on or reads alone: a rank
  int n_massless = 0; ///< coordinates of q2 without mass, of frames given by matrices: M22 is singular
};

/// What acts on every coordinate of the interfaces and what reads it, by name: elements and joints (nonlinear,
/// constrained), springs and dampers, loads, bodies and masses that it carries, signals.  Motions R without stiffness
/// must be held by q1, or C22 is singular: rank R_1 = n_free. Coordinates that nothing acts on and that this rank needs
/// have that reason.
/// @throws std::invalid_argument if the frame is not reduced
Partition partition_of(const Scene &scene, const coupling::Machine &machine,
                       const std::vector<coupling::Signal> &signals);

} // namespace gestell::apps
