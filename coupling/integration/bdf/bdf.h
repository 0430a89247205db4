#pragma once

#include "coupling/integration/bdf/bdf_formula.h"
#include "coupling/integration/step/consistent_start.h"
#include "coupling/integration/step/implicit_step.h"
#include "coupling/integration/step/virtual_rates.h"
#include "coupling/integration/system/excitation_on_grid.h"
#include "coupling/integration/system/resumable.h"
#include "coupling/integration/system/time_integrator.h"

#include <array>
#include <memory>
#include <vector>

namespace gestell::coupling
{

/**
 * BDF (Gear) of order p = 1..6 with fixed step in the form (5.5.2/4-13).
 *
 * With w = M q' + B q (v in the book) and h^q, h^w from past points by (5.5.2/8):
 *
 *     A q_k = M h^q + h_beta h^w + h_beta^2 (f_t + W p),     A = M + h_beta B + h_beta^2 C      (5.5.2/12, 13)
 *     q'_k  = (q_k - h^q)/h_beta,     w_k = h_beta (f_t + W p - C q_k) + h^w                    (5.5.2/6, 10)
 *
 * Self-starting: the first p - 1 points come from implicit Euler steps h/1, h/2, ... extrapolated to order p, so the
 * order is kept from the start. Orders 1 and 2 are stable for every damped mode; orders 3 to 6 are not. Ideal joints
 * enter as g = 0 at the new point (index 3): the order is kept in q and q'. The multipliers of the formula are accurate
 * only after as many points as it has; after every start they are therefore computed from g'' = 0 (ConsistentStart).
 *
 * The force of a sticking measure follows from the equation of motion at q and q', at ends of steps and inside
 * (ConsistentStart::hold()).
 *
 * A step in which Newton fails is divided into two implicit Euler steps of half the length, each divided again up to
 * max_halvings times; the grid is unchanged.
 */
class Bdf : public TimeIntegrator, public Resumable
{
public:
  struct Options
  {
    int           order        = 2;
    double        step         = 0.; ///< h [s], > 0
    int           max_halvings = 10;
    NewtonOptions newton{};
  };

  /// @throws std::invalid_argument for an order outside 1..6 or a step that is not positive.
  Bdf(const SecondOrderSystem &system, const Options &options);

  void begin(double t, const Eigen::VectorXd &q, const Eigen::VectorXd &v) override;
  /// Continues a motion that is known at t and at earlier steps: q[i], v[i] [n] at t - i h.  With as many points as the
  /// order (at most 7) no starting steps are needed.
  /// @throws std::invalid_argument for no points, too many, or different numbers of q and v
  void begin(double t, const std::vector<Eigen::VectorXd> &q, const std::vector<Eigen::VectorXd> &v);
  void advance() override;

  const LocalState      &local() const override { return local_; }
  const Instant         &instant() const override;
  double                 step_begin() const override { return past(n_past_ > 1 ? 1 : 0).t; }
  void                   interpolate(double t, LocalState &state) const override;
  void                   interpolate(double t, Eigen::VectorXd &q, Eigen::VectorXd &v) const override;
  void                   cut(double t) override;
  void                   restart() override;
  const IntegrationWork &work() const override { return work_; }
  void                   exchange(StateArchive &archive) override;

private:
  /// A past point: q, v = q', w = M q' + B q [n]; motion of the measures and their forces.
  struct Point
  {
    double          t = 0.;
    Eigen::VectorXd q, v, w, u, u_rate, a, p, lambda;

    void exchange(StateArchive &archive);
  };

  Point       &past(int i) { return points_[(newest_ + capacity - i) % capacity]; } ///< i = 0: the newest
  const Point &past(int i) const { return points_[(newest_ + capacity - i) % capacity]; }
  void         push();
  void         set(double t, const Eigen::VectorXd &q, const Eigen::VectorXd &v);
  void         begin_from(double t);
  bool         has_consistent();
  bool         is_implied() const; ///< some forces are not values of a law but follow from the equation of motion
  void         find_implied(Point &point);
  void         keep_implied(Point &point) const;
  bool         finds_held() const;
  void         multistep(double t);
  void         start_value(double t);
  void         euler_chain(const Point &from, double length, int n, Point &to);
  void         euler_step(const Point &from, double length, Point &to);
  void         divided_step(const Point &from, double length, int halvings, Point &to);
  void         predict(Eigen::VectorXd Point::*x, Eigen::VectorXd Point::*rate, Eigen::VectorXd &to) const;
  void         formula_step(int order, const Point *const *past, double t, double step, Point &to);
  void         load(double t);
  void         load_on_grid(long k);
  void         present(const Point &point);
  int          interpolation_points(double *t, const Point **points) const;
  int          value_weights(double t, double *weights) const;

  static constexpr int capacity = 8; ///< points stored: up to 6 past ones, the new one, one spare

  const SecondOrderSystem    &system_;
  Options                     options_;
  ImplicitStep                implicit_;
  VirtualRates                virtual_rates_;
  ExcitationOnGrid            load_on_grid_;
  mutable IntegrationWork     work_;
  mutable Instant             now_;
  mutable bool                now_known_ = false;
  double                      t_begin_   = 0.;
  long                        index_     = 0; ///< of the newest point, t = t_begin + index h
  std::array<Point, capacity> points_;
  int                         newest_ = 0, n_past_ = 0;
  Point                       cut_point_;
  bool                        cut_ = false; ///< the present instant is cut_point_, inside the last step
  LocalState                  local_, base_;
  Eigen::VectorXd             f_here_, f_, h_q_, h_w_, g_, g_rate_, product_;
  Eigen::VectorXd             lambda_; ///< predicted multipliers, if the step is sparse
  mutable Eigen::VectorXd     q_inside_, v_inside_;
  bool                        load_known_ = false, on_grid_ = false; ///< the load of this step, and where it is

  std::unique_ptr<ConsistentStart> consistent_;       ///< created when a measure first sticks, or for joints
  bool                             massless_ = false; ///< M is singular: there is no consistent start
};

} // namespace gestell::coupling
