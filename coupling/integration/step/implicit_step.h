#pragma once

#include "coupling/integration/step/compliance.h"
#include "coupling/integration/step/saddle_matrix.h"
#include "coupling/integration/system/second_order_system.h"
#include "coupling/integration/system/time_integrator.h"

#include <array>
#include <map>

namespace gestell::coupling
{

class CondensedMatrix;
class StateArchive;

struct NewtonOptions
{
  double      tolerance      = 1e-10; ///< remaining error, relative to the largest excursion of the measure so far
  int         max_iterations = 25;
  JointSolver joints         = JointSolver::automatic; ///< for systems with ideal joints
  double      share_of_error = 1e-3; ///< with accurate predictions (expect_good_predictions()) the first correction of
                                     ///< each measure is of the size of the local error; this share of it may remain,
                                     ///< at most 1e-7 of its excursion; 0: only the tolerance is used
};

/**
 * The equation of one step of an implicit method, with the unknown x [n] in the units of q:
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
  double time; ///< [s] of the order of the step: the excursion of a measure with rate u' is at least time u'
};

/**
 * The nonlinear equation of one implicit step (5.5.2/12), condensed to the measures on which nonlinear forces act.
 *
 * With constant A, A x_free = f and S = force W^T A^-1 W (Compliance), Newton's method has to solve only
 *
 *     xi = W^T x_free + S p(xi),
 *
 * which is (5.5.3/7) in the measures; x = x_free + force A^-1 W p follows.  For a sticking measure xi is given by its
 * rate, and p is unknown.  Ideal joints add g(t, u) = 0 (index 3) with their multipliers, p = G^T lambda on their
 * measures: Newton's matrix is bordered (CondensedMatrix),
 *
 *     (I - S p') delta - S G^T d_lambda = xi_free + S p - xi,     w_u G delta = -g.
 *
 * It neglects the change of G within a step while corrections contract: lambda g'' is of the order of h^2 lambda/m
 * compared with 1.  The last correction of a step with joints, the turn, evaluates forces and joints where Newton's
 * correction led and uses its factors once more.  It counts in the stopping rule: if a correction of size s contracts
 * by theta, the turn is of the size theta s and leaves theta^2 s.  One factorisation is then usual, and the turn
 * measures theta in every step: if it leaves more than the rounding of positions, Newton's iteration goes on.
 *
 * One factorisation of A and a solve per loaded coordinate are needed for a StepForm; they are cached.
 *
 * With many joints dense matrices are too expensive.  Newton then solves for motion and multipliers at once, with
 * SaddleMatrix:
 *
 *     K [dx, f d_lambda, f d_p_h] = [f_x + f W p - A x,  -g/w_u,  xi_h - W_h^T x],     xi = W^T x,
 *
 * factorised once per step, and again if its corrections stop contracting; G changes little in a step.  The convergence
 * criterion and the results are the same.
 */
class ImplicitStep
{
public:
  ImplicitStep(const SecondOrderSystem &system, const NewtonOptions &options);
  ~ImplicitStep();

  /// Data that depend only on the form.
  struct Condensed
  {
    StepForm                      form;
    std::unique_ptr<LinearSolver> solver; ///< null, and Y, S empty, if is_sparse()
    Eigen::MatrixXd               Y;      // force A^-1 of the loaded coordinates
    Compliance                    S;
    Eigen::MatrixXd               Y_led; // rows of Y of the leading coordinates; empty if W acts on others
  };
  const Condensed &condensed(const StepForm &form, IntegrationWork &work);

  /// Whether solve() also needs a prediction of the whole x.
  bool is_sparse() const { return saddle_ != nullptr; }
  /// Newton's matrix of the last step, factorised; null if it is condensed.
  const SaddleMatrix *saddle() const { return saddle_.get(); }
  /// G where the last step evaluated the joints last: its end but for the last correction, of the size of rounding.
  const ConstraintJacobian &jacobian() const { return G_; }

  /// Solves for x [n].  On entry local.u contains the prediction, local.p that of sticking measures, local.lambda that
  /// of joints; base contains u_0, v_0, a_0 and the time t.  On return local is the solution.  If is_sparse(), the
  /// prediction is that in x.
  /// @throws ConvergenceFailure
  void solve(const Condensed &condensed, const Eigen::VectorXd &f, const LocalState &base, Eigen::VectorXd &x,
             LocalState &local, IntegrationWork &work);
  /// M h + f
  struct MassLoad
  {
    const Eigen::VectorXd &h, &f;
  };
  /// The same for M h + f instead of f; cheaper with few leading coordinates.
  void solve(const Condensed &condensed, const MassLoad &load, const LocalState &base, Eigen::VectorXd &x,
             LocalState &local, IntegrationWork &work);

  /// Whether the following predictions are as accurate as the formula: Newton then stops when the remainder is a small
  /// share of the first correction, which is of the size of the local error.
  void expect_good_predictions(bool good) { good_predictions_ = good && options_.share_of_error > 0.; }

  /// A new motion starts with the measures u, from which their excursions are measured.
  void begin(const Eigen::VectorXd &u);
  /// Force laws changed: the convergence rate of Newton's method must be measured again.
  void forget_contraction();

  /// Data collected from the steps; condensed forms are computed again.
  void exchange(StateArchive &archive);

private:
  static constexpr double unseen_contraction = 1.;    ///< assumed before it is measured
  static constexpr double best_contraction   = 1e-2;  ///< assumed at best for later steps
  static constexpr double good_contraction   = 0.05;  ///< of Newton's corrections: the matrix for G is kept
  static constexpr double turned_little      = 1e-13; ///< correction that changes directions by no more than rounding
  static constexpr double sudden_growth      = 10.;   ///< of the first correction from one step to the next
  static constexpr int    steps_of_levers    = 16;    ///< the levers of joints are checked once in this number of steps
  static constexpr int    most_unseen        = 20;    ///< steps with one iteration before another iteration checks them

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
  bool   ends_at_turn(int iteration, double size, double expected);
  bool   is_converged(int iteration, double size, double remaining) const;
  void   motion(const StepForm &form, const LocalState &base, LocalState &local) const;
  [[noreturn]] void fail(double t) const;

  const SecondOrderSystem                   &system_;
  NewtonOptions                              options_;
  std::map<std::array<double, 4>, Condensed> cache_; ///< by w_M, w_B, w_C, force
  Eigen::VectorXd f_, x_led_, xi_, xi_free_, residual_, u_begin_, scale_, scale_before_, correction_, first_correction_;
  std::vector<ForceBlock>                  force_blocks_;
  std::shared_ptr<const LoadedCoordinates> loaded_;
  ConstraintJacobian                       G_;
  Eigen::VectorXd                          g_;       ///< [n_c] g, then d_lambda
  Eigen::VectorXd                          tangent_; ///< p' by blocks
  std::unique_ptr<CondensedMatrix>         matrix_;  ///< null: sparse
  bool                                     singular_ = false, joints_singular_ = false;
  int                                      dependent_row_ = 0; ///< of the joints, if they are singular
  std::unique_ptr<SaddleMatrix>            saddle_;            ///< null: condensed
  Eigen::VectorXd                          y_;                 ///< [n + n_c + n_h] residual, then correction
  bool                                     good_predictions_ = false;
  bool                                     turn_counts_      = false; ///< in the stopping rule
  double                                   most_left_; ///< of the excursion of a measure, if share_of_error is used
  double contraction_;                                 ///< of Newton's corrections, last measured in steps of this form
  double form_time_ = 0.;                              ///< of this form [s]
  double seen_ = 1., seen_size_ = 1.; ///< the same for good predictions; size of their first correction
  double first_size_ = 0.;            ///< of the first correction in a step
  long   levers_age_ = 0;             ///< [steps]
  int    unseen_     = 0;             ///< steps since the last check
};

/// Reports the sticking measures whose forces are undetermined.
/// @throws ConvergenceFailure always
[[noreturn]] void fail_singular(const SecondOrderSystem &system, double t);
/// Reports that equation `row` of the joints depends on those before it here.
/// @throws ConvergenceFailure always
[[noreturn]] void fail_dependent(const SecondOrderSystem &system, int row, double t);

} // namespace gestell::coupling
