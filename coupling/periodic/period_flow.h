#pragma once

#include "coupling/integration/events/motion.h"
#include "coupling/integration/system/motion_tangents.h"
#include "coupling/periodic/passage_derivative.h"
#include "coupling/periodic/periodic_solution.h"

#include <functional>
#include <memory>

namespace gestell::coupling
{

class VariedMotion;

/// End state of one period.
struct PeriodPassage
{
  double          period = 0.;      ///< T [s]
  Eigen::VectorXd q_begin, v_begin; ///< [n]
  Eigen::VectorXd q, v;             ///< at t_0 + T [n]; along free shifts where it began, and `turn` on
  Eigen::VectorXd shift{};          ///< F s, by which it was put back there [n]; empty: there are no free shifts
  double          fastest = 0.;     ///< max_t sqrt(sum_k q'_k^2)
  Eigen::MatrixXd monodromy;        ///< d(q, q')(T)/d(q, q')(0) [2n x 2n]; empty: not asked for.  Of some
                                    ///< tangents alone: their images [2n x k].  Put back likewise
  std::vector<Event>       events;
  std::vector<std::string> grazing;         ///< events whose guard touches zero without crossing
  double                   chattering = 0.; ///< share of the period with too many events to locate
  IntegrationWork          work;
  long                     runs      = 1;     ///< passages; more: with those for the monodromy matrix
  bool                     condensed = false; ///< the monodromy matrix is that of large motions, PassageDerivative
};

/**
 * The motion over one period of a problem, with the derivative of its end with respect to its start.
 *
 * Tangents are integrated with the motion (MotionTangents).  At an event with guard g, located at t*, the time of the
 * switch moves with the start,
 *
 *     dt* = -(grad g . dx)/g',     dx_behind = dx_before + (x'_before - x'_behind) dt*,
 *
 * the saltation matrix (Aizerman, Gantmakher 1958; Mueller 1995).  Transitions that follow at the same instant share
 * dt*.  If g' is negligible, the event is grazing: dt* is omitted, and this is reported.
 *
 * Beside integrators without tangents VariedMotion has them; the derivative of whole periods is then condensed to large
 * motions (PassageDerivative).
 */
class PeriodFlow : private RunObserver
{
public:
  /// @throws std::invalid_argument as the integrator
  PeriodFlow(const PeriodicProblem &problem, const MethodOptions &integration);
  ~PeriodFlow() override;

  /// Whether tangents are the integrator's own, and cheap.
  bool has_tangents() const { return own_tangents_; }
  /// Of integrators without tangents: the large motions of the last period, to begin with in a flow of a neighbouring
  /// problem.
  const PassageDerivative &derivative() const { return derivative_; }
  void                     begin_with(const PassageDerivative &derivative) { derivative_ = derivative; }
  /// The next matrix is complete.
  void begin_anew() { derivative_.begin_anew(); }
  /// Tangents dq, dv [n x k] with which passages begin, when they are asked for; empty: all of the start.
  void carry(const Eigen::MatrixXd &dq, const Eigen::MatrixXd &dv);

  /// Over `period`; at its end put back along the free shifts of the problem.
  /// @throws ConvergenceFailure
  const PeriodPassage &pass(const Eigen::VectorXd &q, const Eigen::VectorXd &v, double period, bool tangents);
  /// A part of it, from `begin` to `end` [s]; elements begin in the branches of the state.
  /// @throws as pass()
  const PeriodPassage &pass_part(const Eigen::VectorXd &q, const Eigen::VectorXd &v, double begin, double end,
                                 bool tangents);
  /// Until the coordinate `phase` of the problem has come to its value and its turn; at most `longest` [s].
  /// @throws ConvergenceFailure, NoPeriodicMotion if it does not come there
  const PeriodPassage &pass_turn(const Eigen::VectorXd &q, const Eigen::VectorXd &v, double longest);

  const SecondOrderSystem &system() const { return system_; }
  const PeriodPassage     &passage() const { return passage_; }
  /// q'' at the end of the last passage [n].
  const Eigen::VectorXd &end_acceleration();

  /// Moves the end of a last part along the free shifts to where a period began at q [n], with its tangents.
  void put_back(const Eigen::VectorXd &q);

  /// Whether elements have a history at the end of the last passage that a start from the state there would not
  /// reproduce: a sticking measure, or a history beyond its branch. It is reset with the next passage.
  bool remembers_at_end();

  /// `look` is called at samples + 1 instants of every passage.
  void look_on(int samples, std::function<void(const OrbitPoint &)> look);
  /// `look` is called at these shares of every passage, ascending in [0, 1].
  void look_at(std::vector<double> shares, std::function<void(const OrbitPoint &)> look);

private:
  void start(const Eigen::VectorXd &q, const Eigen::VectorXd &v, double begin, double end, bool tangents);
  const PeriodPassage &pass_condensed(const Eigen::VectorXd &q, const Eigen::VectorXd &v, double period);
  void                 require_few(long steps) const;
  void                 finish(const IntegrationWork &before);
  void                 carry_all();
  void                 step() override;
  void                 guard(int number) override;
  void                 event(const Event &) override;
  void                 find_slopes(int guard, Eigen::MatrixXd &gradient, double &partial);
  void                 show(double until);

  const PeriodicProblem                  &problem_;
  SecondOrderSystem                      &system_;
  MethodOptions                           integration_;
  Motion                                  motion_;
  TimeIntegrator                         &integrator_; ///< of it
  bool                                    own_tangents_ = false;
  std::unique_ptr<VariedMotion>           varied_;             ///< in their place
  MotionTangents                         *tangents_ = nullptr; ///< of either
  PeriodPassage                           passage_;
  Eigen::MatrixXd                         dq_begin_, dv_begin_; ///< tangents; empty: all
  Eigen::MatrixXd                         dq_start_, dv_start_; ///< what joints left of them
  bool                                    carries_ = false;
  bool                                    jumps_   = false;       ///< a transition is under way
  double                                  begin_ = 0., end_ = 0.; ///< of the passage [s]
  Eigen::RowVectorXd                      dt_;                    ///< of the event under way
  double                                  t_event_ = 0.;
  Eigen::VectorXd                         before_;     ///< forces before it
  Eigen::VectorXd                         largest_[4]; ///< |u|, |v|, |a|, |p| so far
  PassageDerivative                       derivative_;
  Eigen::VectorXd                         weights_; ///< of its z [2n]
  std::unique_ptr<LinearSolver>           mass_;
  Eigen::VectorXd                         acceleration_;
  std::vector<double>                     looks_; ///< shares of the passage
  std::size_t                             shown_ = 0;
  std::function<void(const OrbitPoint &)> look_;
  std::function<void()>                   at_turn_; ///< after every step of a passage that ends by its turn
  Eigen::VectorXd                         q_look_, v_look_;
  LocalState                              local_look_;
};

/// x [n] without its share along the free shifts of the problem.
Eigen::VectorXd without_free(const PeriodicProblem &problem, const Eigen::VectorXd &x);
/// How far coordinates go in a passage that closes [n]: turn and, along the free shifts, what the motion chose.
Eigen::VectorXd turned(const PeriodicProblem &problem, const PeriodPassage &passage);

/// Sliding speed [m/s, rad/s] that is none in a motion that starts at q, q' and repeats after `period` [s]: what a
/// search leaves of its size.
double still_speed(const SecondOrderSystem &system, const Eigen::VectorXd &q, const Eigen::VectorXd &v, double period);

/// Floquet multipliers: eigenvalues of the monodromy matrix, largest first, without those of free shifts.
Eigen::VectorXcd multipliers_of(const Eigen::MatrixXd &monodromy, const PeriodicProblem &problem);

} // namespace gestell::coupling
