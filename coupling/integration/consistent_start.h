#pragma once

#include "coupling/integration/small_lu.h"
#include "coupling/integration/time_integrator.h"

namespace gestell::coupling
{

/**
 * The acceleration that belongs to q and q' at an instant:
 *
 *     M a = f_t + W p(t, u, u', u'') - B q' - C q.
 *
 * Condensed to the measures, with D = W^T M^-1 W [n_u x n_u]:  u'' = u''_free + D p, which Newton solves where forces
 * depend on u''.  A measure that is held has u'' = 0, and its force p follows from the same equation (index 1).
 *
 * Methods that carry the acceleration from step to step begin with it; M has to be regular for them.
 */
class ConsistentStart
{
public:
  /// Factorises M.
  /// @param method  for messages: "Newmark"
  /// @throws std::invalid_argument if M is singular, naming a coordinate without mass
  ConsistentStart(const SecondOrderSystem &system, const std::string &method);

  /// a [n] at local.t, for which local.u and local.v belong to q, v [n]; fills local.a and local.p.
  /// @throws ConvergenceFailure if p depends on u'' and Newton does not converge
  void solve(const Eigen::VectorXd &q, const Eigen::VectorXd &v, Eigen::VectorXd &a, LocalState &local,
             IntegrationWork &work);

private:
  void iterate(LocalState &local, IntegrationWork &work);

  const SecondOrderSystem      &system_;
  std::unique_ptr<LinearSolver> mass_;
  Eigen::MatrixXd               Y_, D_, dp_; // Y = M^-1 W [n x n_u]
  SmallLu                       jacobian_;
  Eigen::VectorXd               f_, product_, a_free_, correction_;
};

} // namespace gestell::coupling
