#pragma once

#include "apps/output/values/scenery.h"
#include "apps/session/forces/force_places.h"

#include <functional>

namespace gestell::apps
{

/**
 * Forces and torques in space, of an element by the work of its forces p on its measures u = W^T q: at a place of a
 * body that moves by x' = J w' and turns by R w', w = w(q) the measures of the place, force F and torque M about it are
 * those with
 *
 *     (dw/dq)^T (J^T F + R^T M) = W p        for the coordinates that move this body and not the other one,
 *
 * the smallest ones where motions are missing: what holds a body in its plane no coordinate tells.  It is taken at the
 * body that has more motions; the other one, and the ground, bear -F, and -M - (x_1 - x_2) x F: an element without mass
 * is in equilibrium.
 */
class ActingForces
{
public:
  /// @param machine  outlives it
  ActingForces(const Scene &scene, const coupling::Machine &machine);

  /// See Scenery::forces.
  std::vector<ActingForce> at(double t, const Eigen::VectorXd &q, const Eigen::VectorXd &v,
                              const Eigen::VectorXd &p) const;

private:
  const coupling::Machine &machine_;
  ForcePlaces              places_;
};

/// Of a machine that serves pictures; empty: nothing acts.
std::function<std::vector<ActingForce>(double, const Eigen::VectorXd &, const Eigen::VectorXd &,
                                       const Eigen::VectorXd &)>
forces_in_space(const Scene &scene, const coupling::Machine &machine);

} // namespace gestell::apps
