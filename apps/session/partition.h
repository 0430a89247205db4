#pragma once

#include "apps/scene/values/requests.h"
#include "coupling/machine/machine.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/// Reasons why the coordinates of a reduced frame are in q1 (5.5.3/14).
struct Partition
{
  struct Row
  {
    std::string              coordinate; ///< "frame.crown.uz"
    std::vector<std::string> reasons;    ///< "nonlinear: rod"; none: no object of the scene acts on it or reads it
  };
  struct Idle
  {
    std::string interface;
    int         coordinates = 0;
  };

  std::vector<Row>         rows;
  std::vector<Idle>        superfluous; ///< interfaces without a reason
  std::vector<std::string> only_read;   ///< interfaces that only signals read, without loads
  int                      n2      = 0; ///< number of internal DOFs of the unreduced frame
  int                      n_modes = 0;
  int                      n_free  = 0; ///< number of rigid-body modes of the frame, which the fixed interface prevents
  int                      n_held_by_acted = 0; ///< how many of these the coordinates with a reason prevent: a rank
  int n_massless = 0; ///< number of massless coordinates of q2, for frames given by matrices: M22 is singular
};

/// Lists by name what acts on or reads every interface coordinate: elements and joints (nonlinear, constrained),
/// springs and dampers, loads, carried bodies and masses, signals.  Fixing q1 must prevent all rigid-body modes R, or
/// C22 is singular: rank R_1 = n_free. Coordinates without another reason that this rank requires get it as their
/// reason.
/// @throws std::invalid_argument if the frame is not reduced
Partition partition_of(const Scene &scene, const coupling::Machine &machine,
                       const std::vector<coupling::Signal> &signals);

} // namespace gestell::apps
