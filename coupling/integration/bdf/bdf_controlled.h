#pragma once

#include "coupling/integration/bdf/backward_differences.h"
#include "coupling/integration/bdf/bdf_order_limit.h"
#include "coupling/integration/step/consistent_start.h"
#include "coupling/integration/step/implicit_step.h"
#include "coupling/integration/step/virtual_rates.h"
#include "coupling/integration/system/error_control.h"
#include "coupling/integration/system/error_scale.h"
#include "coupling/integration/system/resumable.h"
#include "coupling/integration/system/time_integrator.h"

namespace gestell::coupling
{

/**
 * BDF with controlled step and order, on the equations and the condensed step of Bdf.
 *
 * Steps are h_max / 2^rung and change by powers of two only, so that a factorisation, one per rung and order, is found
 * again whenever the step returns.  Between changes the step is constant: BDF in backward differences of q, q' and of
 * the measures, which a change of step multiplies by a small triangular matrix (BackwardDifferences).  With q' in place
 * of w = M q' + B q, and with the change x = h_b^2 q'' as the unknown, the equation of the step (5.5.2/12) reads
 *
 *     (M + h_b B + h_b^2 C) x = h_b^2 (f_t + W p - B h^{q'} - C (h^q + h_b h^{q'})),
 *     q = h^q + h_b h^{q'} + x,     q' = h^{q'} + x / h_b,
 *
 * in which rounding takes nothing away when h_b^2 C is small beside M, and the error of velocities is at hand.
 *
 * Error.  The local error of order k, nabla^{k+1} / (gamma_k (k + 1)) of q, q', u, u', in the measure of ErrorScale,
 * must not exceed the tolerance.  A step is refused if it does, or if Newton's method fails; then everything is as
 * before it (but see ErrorScale::refuse()), and it is tried with half the length or less.  Two refusals lower the order
 * to 2, three start anew.  The step grows, by up to three rungs at once, after k + 1 steps of equal length, and only if
 * the error expected is below 0.3 of the tolerance, so that it does not come back at once.
 *
 * Order.  With every growth orders k - 1, k + 1 and 2 are looked at as well.  From order 3 on BDF makes lightly damped
 * modes grow where omega h is neither small nor very large, so at each rung only orders are used for which no mode of
 * the base system grows (BdfOrderLimit): frames with damping of 1 % stay at order 2 unless omega h of
 * their highest mode is below 0.34 (orders 3 and 4) or 0.71 (order 5).  Closed contacts change the spectrum; what grows
 * then shows in the error, and refusals lower the order.  With fixed_order this rule does not hold: the caller has
 * looked.
 *
 * Start, and restart at events.  Chains of one, two and four implicit Euler steps over the same length, extrapolated to
 * third order, give three points: BDF2 goes on from there at once with half that length.  Their local error, tested as
 * that of any step, is that of the extrapolation to second order.  They resolve the stiffness that the event brings.  A
 * fixed order above 2 is reached within a few steps, which are as small as the tolerance makes order 2.
 *
 * Newton's tolerance is 1e-2 of the error tolerance, and not below 1e-12.
 *
 * Ideal joints enter as g = 0 at the new point (index 3), condensed to the measures.  A change of step leaves
 * velocities in the directions that joints hold with errors of one order less, and multipliers of two: the local error
 * is that of positions alone then, and multipliers that somebody looks at come from g'' = 0.
 *
 * The force that holds a measure follows from the equation of motion at q and q', at ends of steps and inside
 * (ConsistentStart::hold()): what the formula tells of it has, behind a change of step, errors of one order less.
 *
 * Dense output: cubic Hermite through u, u' (q, q') at both ends for orders 1 and 2, quintic through the three points
 * of a start; the polynomial of degree k + 1 from order 3 on.
 */
class BdfControlled : public TimeIntegrator, public ErrorControl, public Resumable
{
public:
  struct Options
  {
    double        tolerance     = 1e-4;  ///< of the local error for the way gone, see ErrorScale; 1e-13 .. 0.1
    double        largest_step  = 0.;    ///< h_max [s]; 0: 1 / omega of the slowest elastic mode
    double        smallest_step = 0.;    ///< [s]; 0: 2^-40 of the largest
    int           max_order     = 5;     ///< 1..6
    int           min_order     = 0;     ///< 1..max_order; 0: 2, as implicit Euler damps too much, or max_order if less
    bool          fixed_order   = false; ///< max_order throughout
    NewtonOptions newton{};              ///< max_iterations; the tolerance follows from that of the error
  };

  /// @throws std::invalid_argument naming the option, its value and what it may be
  BdfControlled(const SecondOrderSystem &system, const Options &options);

  void begin(double t, const Eigen::VectorXd &q, const Eigen::VectorXd &v) override;
  /// @throws ConvergenceFailure if the step falls below the smallest one
  void advance() override;

  const LocalState &local() const override { return local_; }
  const Instant    &instant() const override;
  double            step_begin() const override { return t_begin_; }
  void              interpolate(double t, LocalState &state) const override;
  void              interpolate(double t, Eigen::VectorXd &q, Eigen::VectorXd &v) const override;
  void motion_at(double t, const std::vector<int> &coordinates, Eigen::VectorXd &q, Eigen::VectorXd &v) const override;
  void cut(double t) override;
  void restart() override;
  const IntegrationWork &work() const override { return work_; }
  void                   exchange(StateArchive &archive) override;
  bool                   controls_error() const override { return true; }
  void                   expect(double way, double speed) override { scale_.expect(way, speed); }

  /// Order and length [s] of the step to come.
  int    order() const { return order_; }
  double step() const { return step_of(rung_); }

private:
  BdfControlled(const SecondOrderSystem &system, const Options &options, const std::vector<SpectrumLine> &spectrum);

  /// What happened to a step that was tried.
  struct Trial
  {
    bool   solved = false; ///< Newton converged
    double error  = 0.;    ///< in units of the tolerance
    double h_beta = 0.;    ///< [s] of its equation
  };

  double             step_of(int rung) const;
  ErrorScale::Motion motion(const Eigen::VectorXd &z) const;
  void               point(const Eigen::VectorXd &z, double t, LocalState &state) const;
  void               present(const Eigen::VectorXd &z, double t);
  void               load(double t);
  bool               is_implied() const; ///< some forces are not values of a law but follow from the equation of motion
  bool               has_consistent();
  bool               finds_held() const;
  void               solve_inside(double t, LocalState &state) const;
  void               find_implied(Eigen::VectorXd &z, double t);
  void               keep_forces(Eigen::VectorXd &z) const;
  void               close_joints();
  double             error_of(const Eigen::Ref<const Eigen::VectorXd> &z) const;
  void               implicit_step(double t, double h_beta, const Eigen::VectorXd &history, Eigen::VectorXd &z);
  bool               is_sound(double h_beta);
  void               multistep();
  void               resolve_stiffness();
  void               improve_middle();
  void               newton_failed(const ConvergenceFailure &failure);
  void               start();
  Trial              try_multistep(double h);
  Trial              try_start(double h);
  void               euler_chain(double length, int n, Eigen::VectorXd &middle, Eigen::VectorXd &end);
  void               refuse(const Trial &trial, double exponent);
  void               choose();
  double             error_of_order(int order) const;
  int                growth(int order, double gain);
  void               change(int rung, int order);
  [[noreturn]] void  fail(double h, const Trial &trial) const;
  void               interpolate_part(double t, Eigen::Index value, Eigen::Index slope, Eigen::VectorXd &x,
                                      Eigen::VectorXd &rate) const;

  const SecondOrderSystem         &system_;
  Options                          options_;
  ErrorScale                       scale_;
  BdfOrderLimit                    limit_;
  ImplicitStep                     implicit_;
  VirtualRates                     virtual_rates_;
  std::unique_ptr<ConsistentStart> consistent_;       ///< once a measure is held
  bool                             massless_ = false; ///< M is singular: no consistent start
  mutable IntegrationWork          work_;
  Eigen::Index                     n_, n_u_, n_c_; ///< z = (q, q', u, u', u'', p, lambda) [2 n + 4 n_u + n_c]
  BackwardDifferences              differences_;
  int                              order_ = 1, rung_ = 0;
  int                              wanted_order_ = 1, wanted_rung_ = 0; ///< from the next step on
  int                              since_change_ = 0;                   ///< steps of this length and order
  int                              barred_       = 0;                   ///< steps for which orders above 2 are not used
  bool                             fresh_        = true;                ///< the past is forgotten
  bool                             started_      = false;               ///< the last step was a start
  bool                             cut_          = false;
  double                           anchor_       = 0.; ///< t_n = anchor + steps * h
  long                             steps_        = 0;
  double                           t_begin_ = 0., t_end_ = 0.; ///< of the last step
  Eigen::VectorXd                  z_begin_, z_cut_, z_, predicted_, difference_, history_;
  Eigen::VectorXd                  chain_[2], middle_[3], end_[3];
  Eigen::MatrixXd                  dp_du_, dp_dv_, pivots_;
  Eigen::VectorXd                  stiffness_; ///< -dp/du by measure, before an event; then its change there [n_u]
  Eigen::VectorXd                  moved_;     ///< max_k S_jk p_k of the last step tried [n_u]
  std::string                      reason_, reason_id_, reason_place_; ///< of Newton's last failure
  LocalState                       local_, base_;
  mutable Instant                  now_;
  mutable bool                     now_known_  = false;
  bool                             load_known_ = false;
  Eigen::VectorXd                  f_t_, f_, h_q_, h_v_, x_, product_;
  mutable Eigen::VectorXd          q_inside_, v_inside_, a_inside_;
  mutable LocalState               inside_;
  Eigen::VectorXd                  lambda_size_;           ///< [n_c] largest so far
  double                           fastest_load_  = 0.;    ///< [rad/s]
  bool                             solves_inside_ = false; ///< multipliers change more in a step than polynomials tell
  Eigen::VectorXd                  no_v_, no_rate_;        ///< zeros, for errors of positions alone [n], [n_u]
};

} // namespace gestell::coupling
