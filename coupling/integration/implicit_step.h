#pragma once

#include "coupling/integration/second_order_system.h"
#include "coupling/integration/small_lu.h"
#include "coupling/integration/time_integrator.h"

#include <array>
#include <map>

namespace gestell::coupling
{

struct NewtonOptions
{
  double tolerance      = 1e-10; ///< of the error left, relative to the largest excursion of the measure so far
  int    max_iterations = 25;
};

/**
 * What one step of an implicit method solves for, x [n] in the units of q:
 *
 *     (w_M M + w_B B + w_C C) x = f + force W p(u, u', u''),
 *     u = u_0 + w_u xi,   u' = v_0 + w_v xi,   u'' = a_0 + w_a xi,   xi = W^T x.
 *
 * BDF: x = q, (1, h_b, h_b^2), force h_b^2, (w_u, w_v, w_a) = (1, 1/h_b, 1/h_b^2).  The methods of Newmark's family:
 * x = h^2 q''.
 */
struct StepForm
{
  double w_M, w_B, w_C, force;
  double w_u, w_v, w_a;
  double time; ///< [s] of the order of the step: a measure that moves with u' counts as having gone time u'
};

/**
 * The nonlinear equation of one implicit step (5.5.2/12), condensed to the measures on which nonlinear forces act.
 *
 * With A constant, A x_free = f, Y = force A^-1 W and S = W^T Y [n_u x n_u] leave Newton only
 *
 *     xi = W^T x_free + S p(xi),
 *
 * which is (5.5.3/7) in the measures; x = x_free + Y p follows.  A measure that is held has xi given by its rate and p
 * as unknown.  One factorisation of A and n_u solves per StepForm, kept for later use.
 */
class ImplicitStep
{
public:
  ImplicitStep(const SecondOrderSystem &system, const NewtonOptions &options);

  /// Everything that depends on the form alone.
  struct Condensed
  {
    StepForm                      form;
    std::unique_ptr<LinearSolver> solver;
    Eigen::MatrixXd               Y; // [n x n_u]
    Eigen::MatrixXd               S; // [n_u x n_u]
  };
  const Condensed &condensed(const StepForm &form, IntegrationWork &work);

  /// Solves for x [n].  local.u holds the prediction on entry, local.p that of held measures; base holds u_0, v_0, a_0
  /// and the time t.  local is the solution on return.
  /// @throws ConvergenceFailure
  void solve(const Condensed &condensed, const Eigen::VectorXd &f, const LocalState &base, Eigen::VectorXd &x,
             LocalState &local, IntegrationWork &work);

  /// A new motion begins with the measures u: their excursions are counted from there.
  void begin(const Eigen::VectorXd &u);

private:
  bool iterate(const Condensed &condensed, const LocalState &base, LocalState &local, IntegrationWork &work);
  void motion(const StepForm &form, const LocalState &base, LocalState &local) const;
  [[noreturn]] void fail(double t) const;

  const SecondOrderSystem                   &system_;
  NewtonOptions                              options_;
  std::map<std::array<double, 4>, Condensed> cache_; ///< by w_M, w_B, w_C, force
  Eigen::VectorXd                            xi_, xi_free_, residual_, u_begin_, scale_, scale_before_, correction_;
  Eigen::MatrixXd                            dp_;
  SmallLu                                    jacobian_;
  bool                                       singular_ = false;
  double                                     contraction_; ///< of Newton's corrections, as seen last
};

/// Tells which measures that stick leave their forces undetermined.
/// @throws ConvergenceFailure always
[[noreturn]] void fail_singular(const SecondOrderSystem &system, double t);

} // namespace gestell::coupling
