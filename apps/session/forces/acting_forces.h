#pragma once

#include "apps/output/values/scenery.h"
#include "apps/session/forces/force_places.h"

#include <functional>

namespace gestell::apps
{

/**
 * Forces and torques in space, from the virtual work of an element's forces p on its measures u = W^T q.  A point of a
 * body has the velocity x' = J w' and the angular velocity R w', where w = w(q) are its measures.  Force F and torque M
 * about the point follow from
 *
 *     (dw/dq)^T (J^T F + R^T M) = W p        for the coordinates that move this body and not the other one,
 *
 * by the minimum norm if DOFs are missing: no coordinate determines the force that keeps a body in its plane.  They are
 * computed at the body with more DOFs; the other body, or the ground, receives -F and -M - (x_1 - x_2) x F, because an
 * element without mass is in equilibrium.
 */
class ActingForces
{
public:
  /// @param machine  must outlive this object
  ActingForces(const Scene &scene, const coupling::Machine &machine);

  /// See Scenery::forces.
  std::vector<ActingForce> at(double t, const Eigen::VectorXd &q, const Eigen::VectorXd &v,
                              const Eigen::VectorXd &p) const;

private:
  const coupling::Machine &machine_;
  ForcePlaces              places_;
};

/// The forces for pictures of this machine; empty: there are none.
std::function<std::vector<ActingForce>(double, const Eigen::VectorXd &, const Eigen::VectorXd &,
                                       const Eigen::VectorXd &)>
forces_in_space(const Scene &scene, const coupling::Machine &machine);

} // namespace gestell::apps
