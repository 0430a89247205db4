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
};

/// What acts on every coordinate of the interfaces and what reads it, by name: elements and joints (nonlinear,
/// constrained), springs and dampers, loads, bodies and masses that it carries, signals.
/// @throws std::invalid_argument if the frame is not reduced
Partition partition_of(const Scene &scene, const coupling::Machine &machine,
                       const std::vector<coupling::Signal> &signals);

} // namespace gestell::apps
