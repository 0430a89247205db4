#pragma once

#include "coupling/integration/step/condensed_matrix.h"
#include "coupling/integration/step/saddle_matrix.h"
#include "coupling/integration/system/second_order_system.h"
#include "coupling/integration/system/time_integrator.h"

#include <array>
#include <map>

namespace gestell::coupling
{

class StateArchive;

struct NewtonOptions
{
  double      tolerance      = 1e-10; ///< of the error left, relative to the largest excursion of the measure so far
  int         max_iterations = 25;
  JointSolver joints         = JointSolver::automatic; ///< of systems with ideal joints
  double      share_of_error = 1e-3; ///< of the first correction of each measure that may be left where it is as large
                                     ///< as the local error, but at most 1e-7 of its excursion:
                                     ///< expect_good_predictions(); 0: the tolerance alone counts
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
 * as unknown.  Ideal joints add g(t, u) = 0 (index 3) with their multipliers, p = G^T lambda on their measures:
 * Newton's matrix is bordered (CondensedMatrix),
 *
 *     (I - S p') delta - S G^T d_lambda = xi_free + S p - xi,     w_u G delta = -g.
 *
 * How G turns within a step is left out of it, as long as corrections contract: lambda g'' is of the order of h^2
 * lambda/m against 1.
 *
 * One factorisation of A and n_u solves per StepForm, kept for later use.
 *
 * With many joints all that is dense is too much.  Newton then works on motion and multipliers at once, with
 * SaddleMatrix:
 *
 *     K [dx, f d_lambda, f d_p_h] = [f_x + f W p - A x,  -g/w_u,  xi_h - W_h^T x],     xi = W^T x,
 *
 * factorised once per step, and again where its corrections stop contracting; G turns little in a step.  What counts as
 * converged, and the results, are the same.
 */
class ImplicitStep
{
public:
  ImplicitStep(const SecondOrderSystem &system, const NewtonOptions &options);

  /// Everything that depends on the form alone.
  struct Condensed
  {
    StepForm                      form;
    std::unique_ptr<LinearSolver> solver; ///< null, and Y, S empty, if is_sparse()
    Eigen::MatrixXd               Y;      // [n x n_u]
    Eigen::MatrixXd               S;      // [n_u x n_u]
    Eigen::MatrixXd               Y_led;  // [n_N x n_u] rows of Y of the leading coordinates; empty if W acts on others
  };
  const Condensed &condensed(const StepForm &form, IntegrationWork &work);

  /// True: solve() wants a prediction of the whole x, too.
  bool is_sparse() const { return saddle_ != nullptr; }

  /// Solves for x [n].  local.u holds the prediction on entry, local.p that of held measures, local.lambda that of
  /// joints; base holds u_0, v_0, a_0 and the time t.  local is the solution on return.  If is_sparse(), x is the
  /// prediction that counts.
  /// @throws ConvergenceFailure
  void solve(const Condensed &condensed, const Eigen::VectorXd &f, const LocalState &base, Eigen::VectorXd &x,
             LocalState &local, IntegrationWork &work);
  /// M h + f
  struct MassLoad
  {
    const Eigen::VectorXd &h, &f;
  };
  /// The same for M h + f instead of f; less work where few coordinates lead.
  void solve(const Condensed &condensed, const MassLoad &load, const LocalState &base, Eigen::VectorXd &x,
             LocalState &local, IntegrationWork &work);

  /// Whether the predictions that follow err as little as the formula does: Newton stops then where what is left is a
  /// small share of the first correction, which is of the size of the local error.
  void expect_good_predictions(bool good) { good_predictions_ = good && options_.share_of_error > 0.; }

  /// A new motion begins with the measures u: their excursions are counted from there.
  void begin(const Eigen::VectorXd &u);
  /// Force laws changed: the convergence rate of Newton's method must be measured again.
  void forget_contraction();

  /// What was seen of the steps made; forms that were condensed are condensed again.
  void exchange(StateArchive &archive);

private:
  static constexpr double unseen_contraction = 1.;    ///< of Newton where it has not been seen: nothing is expected
  static constexpr double best_contraction   = 1e-2;  ///< that is expected of the steps to come
  static constexpr double good_contraction   = 0.05;  ///< of Newton's corrections: what was made of G serves on
  static constexpr double turned_little      = 1e-13; ///< correction that turns no direction by more than rounding
  static constexpr double sudden_growth      = 10.;   ///< of the first correction from step to step
  static constexpr int    steps_of_levers    = 16;    ///< the levers of joints are checked once in this number of
  static constexpr int    most_unseen        = 20;    ///< steps of one iteration before another one is checked

  void find_forces(const Condensed &condensed, const LocalState &base, const Eigen::VectorXd &x, LocalState &local,
                   IntegrationWork &work);
  void grow_scale(const StepForm &form, const LocalState &local, bool of_joints_too);
  static double damping_of(int iteration, double size, double size_before);

  bool   correct(const Condensed &condensed, const LocalState &local);
  void   finish(const StepForm &form, const LocalState &base, LocalState &local);
  void   take_forces(LocalState &local);
  void   follow_turn(const Condensed &condensed, const LocalState &base, LocalState &local);
  bool   follow_turn_sparse(const StepForm &form, const Eigen::VectorXd &f, const LocalState &base, Eigen::VectorXd &x,
                            LocalState &local);
  void   find_measures(const Eigen::VectorXd &x, const StepForm &form, const LocalState &base);
  bool   correct_sparse(const StepForm &form, const Eigen::VectorXd &f, const Eigen::VectorXd &x, LocalState &local);
  bool   iterate(const Condensed &condensed, const LocalState &base, LocalState &local, IntegrationWork &work);
  bool   iterate_sparse(const StepForm &form, const Eigen::VectorXd &f, const LocalState &base, Eigen::VectorXd &x,
                        LocalState &local, IntegrationWork &work);
  bool   factorise_sparse(IntegrationWork &work);
  void   add_tangent_times(const Eigen::VectorXd &xi, Eigen::VectorXd &p) const;
  double size_of_correction() const;
  void   note_form(const StepForm &form);
  double remaining(int iteration, double size, double size_before);
  bool   is_converged(int iteration, double size, double remaining) const;
  void   motion(const StepForm &form, const LocalState &base, LocalState &local) const;
  [[noreturn]] void fail(double t) const;

  const SecondOrderSystem                   &system_;
  NewtonOptions                              options_;
  std::map<std::array<double, 4>, Condensed> cache_; ///< by w_M, w_B, w_C, force
  Eigen::VectorXd f_, x_led_, xi_, xi_free_, residual_, u_begin_, scale_, scale_before_, correction_, first_correction_;
  std::vector<ForceBlock>          force_blocks_;
  ConstraintJacobian               G_;
  Eigen::VectorXd                  g_;       ///< [n_c] g, then d_lambda
  Eigen::VectorXd                  tangent_; ///< p' by blocks
  std::unique_ptr<CondensedMatrix> matrix_;  ///< null: sparse
  bool                             singular_ = false, joints_singular_ = false;
  int                              dependent_row_ = 0; ///< of the joints, where these are singular
  std::unique_ptr<SaddleMatrix>    saddle_;            ///< null: condensed
  Eigen::VectorXd                  y_;                 ///< [n + n_c + n_h] residual, then correction
  bool                             good_predictions_ = false;
  double                           most_left_;      ///< of the excursion of a measure, where share_of_error counts
  double                           contraction_;    ///< of Newton's corrections, as seen last in steps of this form
  double                           form_time_ = 0.; ///< of these [s]
  double seen_ = 1., seen_size_ = 1.;               ///< the same of good predictions, after a first one of that size
  double first_size_ = 0.;                          ///< of the first correction of a step
  long   levers_age_ = 0;                           ///< [steps]
  int    unseen_     = 0;                           ///< steps since
};

/// Tells which measures that stick leave their forces undetermined.
/// @throws ConvergenceFailure always
[[noreturn]] void fail_singular(const SecondOrderSystem &system, double t);
/// Tells that equation `row` of the joints depends on those before it here.
/// @throws ConvergenceFailure always
[[noreturn]] void fail_dependent(const SecondOrderSystem &system, int row, double t);

} // namespace gestell::coupling
