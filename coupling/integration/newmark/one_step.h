#pragma once

#include "coupling/integration/step/consistent_start.h"
#include "coupling/integration/step/implicit_step.h"
#include "coupling/integration/system/resumable.h"
#include "coupling/integration/system/time_integrator.h"

#include <vector>

namespace gestell::coupling
{

/**
 * Common part of methods with fixed step that proceed from one point with q, q' and an acceleration to the next.
 *
 * - Start and restart: the acceleration of the equation of motion there (ConsistentStart), so M must be regular.
 * - A step in which Newton fails is divided into two steps of half the length by the same formula, each divided again
 *   up to max_halvings times; the grid is unchanged.
 * - Dense output: cubic Hermite through q, q' at both ends (order 4 in the step), q' its derivative; a and p linear.
 * - The force of a sticking measure follows from the equation of motion at q and q', at ends of steps and inside
 *   (ConsistentStart::hold()).
 * - The same applies to multipliers of ideal joints if they are requested: those of the method, which averages forces,
 *   are valid at another instant and oscillate around the true ones from step to step.
 * - A cut uses the dense output; the next advance() restarts there.
 */
class OneStep : public TimeIntegrator, public Resumable
{
public:
  void begin(double t, const Eigen::VectorXd &q, const Eigen::VectorXd &v) override;
  /// Continues a motion with known acceleration a [n] in the state of the method.
  void begin(double t, const Eigen::VectorXd &q, const Eigen::VectorXd &v, const Eigen::VectorXd &a);
  void advance() override;

  const LocalState      &local() const override { return present().motion.local; }
  const Instant         &instant() const override { return present().motion; }
  const Eigen::VectorXd &acceleration() const { return present().a; } ///< [n], in the state of the method
  double                 step_begin() const override { return (stepped_ ? begin_ : end_).motion.t; }
  void                   interpolate(double t, LocalState &state) const override;
  void                   interpolate(double t, Eigen::VectorXd &q, Eigen::VectorXd &v) const override;
  void motion_at(double t, const std::vector<int> &coordinates, Eigen::VectorXd &q, Eigen::VectorXd &v) const override;
  void cut(double t) override;
  void restart() override;
  const IntegrationWork &work() const override { return work_; }
  void                   exchange(StateArchive &archive) override;

protected:
  /// A point of time: motion, acceleration in the state of the method, and load f_t, both [n].
  struct Point
  {
    Instant         motion;
    Eigen::VectorXd a, f;
    Eigen::VectorXd p, lambda; ///< [n_u], [n_c] as the method balances them; those of the motion if computed

    void keep_balance(); ///< copies those of the motion
    void exchange(StateArchive &archive);
  };

  /// @param name  of the method, for messages
  /// @throws std::invalid_argument for a step that is not positive, constraints, singular M
  OneStep(const SecondOrderSystem &system, const std::string &name, double step, int max_halvings,
          const NewtonOptions &newton);

  /// One step of length h from `from`; on entry to.motion.local.p is that of `from`.
  /// @throws ConvergenceFailure
  virtual void formula_step(const Point &from, double h, Point &to) = 0;

  const SecondOrderSystem &system_;
  ImplicitStep             implicit_;
  mutable IntegrationWork  work_;

private:
  const Point &present() const { return cut_ ? cut_point_ : end_; }
  void         resize(Point &point) const;
  void         place(double t, const Eigen::VectorXd &q, const Eigen::VectorXd &v);
  void         step_or_divide(const Point &from, double length, int halvings, Point &to);

  double                  step_;
  int                     max_halvings_;
  mutable ConsistentStart start_;
  Point                   begin_, end_, cut_point_;
  mutable Eigen::VectorXd q_inside_, v_inside_;
  std::vector<Point>      middle_; ///< of divided steps, by the number of halvings
  double                  t_begin_ = 0.;
  long                    index_   = 0;     ///< of the end of the last step, t = t_begin + index h
  bool                    stepped_ = false; ///< begin_ and end_ bound a step
  bool                    cut_     = false; ///< the present instant is cut_point_, inside the last step
};

} // namespace gestell::coupling
