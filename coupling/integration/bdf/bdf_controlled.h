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
 * BDF with variable step and order, with the equations and the condensed step of Bdf.
 *
 * Steps are h_max / 2^rung and change only by powers of two, so that a factorisation, one per level and order, is
 * reused whenever a step length returns. Between changes the step is constant: BDF in backward differences of q, q' and
 * of the measures, which a change of step multiplies by a small triangular matrix (BackwardDifferences). With q' in
 * place of w = M q' + B q, and with the change x = h_b^2 q'' as the unknown, the equation of the step (5.5.2/12) reads
 *
 *     (M + h_b B + h_b^2 C) x = h_b^2 (f_t + W p - B h^{q'} - C (h^q + h_b h^{q'})),
 *     q = h^q + h_b h^{q'} + x,     q' = h^{q'} + x / h_b,
 *
 * which has no cancellation if h_b^2 C is small compared with M, and which gives the error of velocities.
 *
 * Error. The local error of order k, nabla^{k+1} / (gamma_k (k + 1)) of q, q', u, u', in the norm of ErrorScale, must
 * not exceed the tolerance. Otherwise, or if Newton's method fails, the step is rejected; the state before it is
 * restored (but see ErrorScale::refuse()), and the step is repeated with half the length or less. Two rejections reduce
 * the order to 2, three cause a restart. The step grows, by up to three levels at once, after k + 1 steps of equal
 * length, and only if the predicted error is below 0.3 of the tolerance, so that it is not reduced again immediately.
 *
 * Order.  Whenever the step grows, orders k - 1, k + 1 and 2 are also examined.  BDF of order 3 and above makes lightly
 * damped modes grow if omega h is neither small nor very large.  Therefore at each level only orders are used for which
 * no mode of the base system grows (BdfOrderLimit): frames with damping of 1 % remain at order 2 unless omega h of
 * their highest mode is below 0.34 (orders 3 and 4) or 0.71 (order 5).  Closed contacts change the spectrum; growth
 * then appears in the error, and rejections reduce the order.  With fixed_order this rule does not apply: the caller is
 * responsible.
 *
 * Start, and restart at events.  Chains of one, two and four implicit Euler steps over the same length, extrapolated to
 * third order, give three points, from which BDF2 continues with half that length.  Their local error, tested like that
 * of any step, is that of the extrapolation to second order.  They resolve the stiffness after the event.  A fixed
 * order above 2 is reached within a few steps, whose length the tolerance determines for order 2.
 *
 * Newton's tolerance is 1e-2 of the error tolerance, but at least 1e-12.
 *
 * Ideal joints enter as g = 0 at the new point (index 3), condensed to the measures.  A change of step reduces the
 * order of velocities in constrained directions by one, and that of multipliers by two: the local error is then that of
 * positions only, and multipliers, if requested, are computed from g'' = 0.
 *
 * The force of a sticking measure follows from the equation of motion at q and q', at ends of steps and inside
 * (ConsistentStart::hold()): the formula's own value loses one order after a change of step.
 *
 * Dense output: cubic Hermite through u, u' (q, q') at both ends for orders 1 and 2, quintic through the three points
 * of a start; the polynomial of degree k + 1 for order 3 and above.
 */
class BdfControlled : public TimeIntegrator, public ErrorControl, public Resumable
{
public:
  struct Options
  {
    double        tolerance     = 1e-4;  ///< of the local error per range of motion, see ErrorScale; 1e-13 .. 0.1
    double        largest_step  = 0.;    ///< h_max [s]; 0: 1 / omega of the slowest elastic mode
    double        smallest_step = 0.;    ///< [s]; 0: 2^-40 of the largest
    int           max_order     = 5;     ///< 1..6
    int           min_order     = 0;     ///< 1..max_order; 0: 2 (implicit Euler damps too much), or max_order if less
    bool          fixed_order   = false; ///< always max_order
    NewtonOptions newton{};              ///< max_iterations; the tolerance follows from that of the error
  };

  /// @throws std::invalid_argument with the option, its value and the allowed range
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

  /// Order and length [s] of the next step.
  int    order() const { return order_; }
  double step() const { return step_of(rung_); }

private:
  BdfControlled(const SecondOrderSystem &system, const Options &options, const std::vector<SpectrumLine> &spectrum);

  /// Result of a tried step.
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
  std::unique_ptr<ConsistentStart> consistent_;       ///< created when a measure first sticks
  bool                             massless_ = false; ///< M is singular: no consistent start
  mutable IntegrationWork          work_;
  Eigen::Index                     n_, n_u_, n_c_; ///< z = (q, q', u, u', u'', p, lambda) [2 n + 4 n_u + n_c]
  BackwardDifferences              differences_;
  int                              order_ = 1, rung_ = 0;
  int                              wanted_order_ = 1, wanted_rung_ = 0; ///< for the next step
  int                              since_change_ = 0;                   ///< number of steps with this length and order
  int                              barred_       = 0;                   ///< steps without orders above 2
  bool                             fresh_        = true;                ///< there are no past points
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
  bool                             solves_inside_ = false; ///< multipliers vary too much in a step for polynomials
  Eigen::VectorXd                  no_v_, no_rate_;        ///< zeros, for errors of positions only [n], [n_u]
};

} // namespace gestell::coupling
