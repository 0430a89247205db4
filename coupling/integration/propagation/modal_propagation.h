#pragma once

#include "coupling/integration/propagation/force_step.h"
#include "coupling/integration/system/error_control.h"
#include "coupling/integration/system/motion_tangents.h"
#include "coupling/integration/system/resumable.h"
#include "coupling/integration/system/time_integrator.h"

#include <cstdint>
#include <map>
#include <memory>

namespace gestell::coupling
{

/**
 * Exact propagation of the linear base system (5.5.2/1) in its modes, with element forces interpolated in time.
 *
 *     x' = Lambda x + G (f_t + W p),     x(t + h) = e^(Lambda h) x + int_0^h e^(Lambda (h - s)) G (f_t + W p) ds
 *
 * Lambda is block diagonal (ModalBlocks), constant and harmonic loads are propagated exactly, and p is a polynomial
 * over the step (ForceRule).  Therefore only the elements limit the step: a frame mode of 5 kHz affects neither
 * accuracy nor stability.  A step reads and writes every mode once; n_u unknowns remain.
 *
 *     average      order 2, stable at every contact
 *     linear       order 2, one evaluation a step, stable up to omega_contact h = 2 sqrt(3)
 *     collocation  order 2 s with s Gauss points, 2 <= 2 s <= 8
 *
 * Inside a step the measures are interpolated; with collocation they are computed from the modes if the phase of these
 * advances too much in a step for interpolation.
 *
 * The force of a sticking measure follows from the equation of motion at x, at ends of steps and inside.
 *
 * Steps are on the grid t_begin + k h / 2^r: after an event a shorter step returns to it, so that all others share
 * their tables.  If Newton fails, or with a tolerance if the local error is too large, r grows; it falls again when the
 * grid allows it.
 */
class ModalPropagation : public TimeIntegrator, public ErrorControl, public MotionTangents, public Resumable
{
public:
  struct Options
  {
    ForceRule     force     = ForceRule::collocation;
    int           order     = 6;  ///< of collocation: 2, 4, 6 or 8
    double        step      = 0.; ///< h [s], the largest one with a tolerance; 0 there: chosen from the lowest mode
    double        tolerance = 0.; ///< of the local error in the measures, relative to their largest excursion; 0: fixed
    int           max_halvings = 24;
    NewtonOptions newton{};
    std::shared_ptr<SharedModes> modes; ///< of systems with the same matrices; null: its own
  };

  /// @throws std::invalid_argument as modal_blocks() does
  ModalPropagation(const SecondOrderSystem &system, const Options &options);

  void begin(double t, const Eigen::VectorXd &q, const Eigen::VectorXd &v) override;
  void advance() override;

  const LocalState &local() const override { return local_; }
  const Instant    &instant() const override;
  double            step_begin() const override { return t_begin_; }
  void              interpolate(double t, LocalState &state) const override;
  void              interpolate(double t, Eigen::VectorXd &q, Eigen::VectorXd &v) const override;
  void motion_at(double t, const std::vector<int> &coordinates, Eigen::VectorXd &q, Eigen::VectorXd &v) const override;
  int  parts_of_step() const override;
  void cut(double t) override;
  void restart() override;
  const IntegrationWork &work() const override { return context_.work; }
  bool                   controls_error() const override { return options_.tolerance > 0.; }
  void                   expect(double way, double speed) override;
  void                   exchange(StateArchive &archive) override;

  void          begin_tangents(const Eigen::MatrixXd &dq, const Eigen::MatrixXd &dv) override;
  void          carry_tangents() override;
  void          jump_tangents(const Eigen::VectorXd &before, const Eigen::RowVectorXd &dt) override;
  void          tangents(Eigen::MatrixXd &dq, Eigen::MatrixXd &dv) const override;
  LocalTangents local_tangents() override { return local_tangents_of(X_); }
  LocalTangents local_rates() override;

private:
  using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>; // only rows are read

  static constexpr int finest = 30; ///< ticks are h / 2^finest

  /// End of the current step.
  struct Target
  {
    double  t = 0., h = 0.;
    int64_t tick    = 0;
    bool    on_grid = false; ///< h is that of a step-size level
    int     rung    = 0;
  };

  Target                 next_target() const;
  const StepTable       &table_for(const Target &target);
  double                 spacing(int rung) const { return std::ldexp(step_, -rung); }
  bool                   attempt(const Target &target);
  void                   start_piece();
  LocalTangents          local_tangents_of(const Eigen::MatrixXd &X);
  void                   turn_harmonics();
  void                   refuse_accelerations();
  void                   forget_inside();
  bool                   is_smooth(double h) const;
  void                   hold_rates(double t, Eigen::VectorXd &x) const;
  const Eigen::VectorXd &state_at(double t) const; ///< x [2 n_p] inside the last step or at its end
  [[noreturn]] void      fail(const std::string &reason) const;

  const SecondOrderSystem   &system_;
  Options                    options_;
  ModalBlocks                modes_;
  mutable PropagationContext context_;
  std::unique_ptr<ForceStep> force_;
  RowMatrix                  Q_, V_;  ///< [n x 2 n_p]
  std::map<int, StepTable>   tables_; ///< by step-size level
  StepTable                  partial_;
  double                     step_ = 0., t_origin_ = 0., t_begin_ = 0.;
  double                     t_full_  = 0.; ///< end of the step before it was cut
  int64_t                    tick_    = 0;
  bool                       on_grid_ = true, cut_ = false, stepped_ = false;
  int                        rung_       = 0;
  double                     last_error_ = 0.; ///< of the previous step, in tolerances
  Target                     target_;
  LocalState                 local_, local_begin_;
  Eigen::VectorXd            x_;
  Eigen::MatrixXd            X_; ///< tangents of the states [2 n_p x k]
  mutable Eigen::VectorXd    x_work_, x_inside_, forces_;
  mutable LocalState         held_; ///< scratch of hold_rates()
  mutable Instant            now_;
  mutable bool               now_known_ = false;
  mutable double             h_smooth_  = 0.; ///< of the last step, if is_smooth() has checked it; else 0
  mutable bool               smooth_    = true;
  double                     fastest_   = 0.; ///< of all blocks [1/s]
  mutable double             t_inside_  = 0.; ///< time of x_inside_, inside the last step; else it is unknown
};

} // namespace gestell::coupling
