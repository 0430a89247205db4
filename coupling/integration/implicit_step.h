#pragma once

#include "coupling/integration/second_order_system.h"
#include "coupling/integration/time_integrator.h"

#include <map>

namespace gestell::coupling
{

struct NewtonOptions
{
  double tolerance      = 1e-10; ///< of the error left, relative to the largest excursion of the measure so far
  int    max_iterations = 25;
};

/**
 * The nonlinear equation of one implicit step (5.5.2/12), condensed to the measures on which nonlinear forces act.
 *
 *     A q = f + h_beta^2 W p(u, u', u''),   u = W^T q,   u' = (u - g)/h_beta,   u'' = (u' - g')/h_beta
 *
 * With A constant, A q_free = f, Y = h_beta^2 A^-1 W and S = W^T Y [n_u x n_u] leave Newton only
 *
 *     u = W^T q_free + S p(u),
 *
 * which is (5.5.3/7) in the measures; q = q_free + Y p follows.  One factorisation of A and n_u solves per h_beta, kept
 * for later use.  g, g' hold what the integration formula takes from the past of u and u'.
 */
class ImplicitStep
{
public:
  ImplicitStep(const SecondOrderSystem &system, const NewtonOptions &options);

  /// Everything that depends on h_beta alone.
  struct Condensed
  {
    double                        h_beta;
    std::unique_ptr<LinearSolver> solver;
    Eigen::MatrixXd               Y; // [n x n_u]
    Eigen::MatrixXd               S; // [n_u x n_u]
  };
  const Condensed &condensed(double h_beta, IntegrationWork &work);

  /// Solves for q [n] at time t.  `local.u` holds the prediction on entry; local and p the solution on return.
  /// @throws ConvergenceFailure
  void solve(const Condensed &condensed, double t, const Eigen::VectorXd &f, const Eigen::VectorXd &g,
             const Eigen::VectorXd &g_rate, Eigen::VectorXd &q, LocalState &local, Eigen::VectorXd &p,
             IntegrationWork &work);

  /// A new motion begins with the measures u: their excursions are counted from there.
  void begin(const Eigen::VectorXd &u);

private:
  bool iterate(const Condensed &condensed, const Eigen::VectorXd &g, const Eigen::VectorXd &g_rate, LocalState &local,
               Eigen::VectorXd &p, IntegrationWork &work);
  void rates(double h_beta, const Eigen::VectorXd &g, const Eigen::VectorXd &g_rate, LocalState &local) const;
  [[noreturn]] void fail(double t) const;

  const SecondOrderSystem    &system_;
  NewtonOptions               options_;
  std::map<double, Condensed> cache_;
  Eigen::VectorXd             u_free_, residual_, u_begin_, scale_, correction_;
  Eigen::MatrixXd             dp_, jacobian_;
  double                      contraction_; ///< of Newton's corrections, as seen last
};

} // namespace gestell::coupling
