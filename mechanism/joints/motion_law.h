#pragma once

#include "mechanism/functions/commanded_profile.h"
#include "mechanism/functions/position_function.h"

#include <string>
#include <vector>

namespace gestell::mechanism
{

/// A prescribed motion f(t) with its first two derivatives, [m] or [rad].
struct PrescribedMotion
{
  double value = 0., rate = 0., acceleration = 0.;
};

/**
 * A prescribed motion, smooth between corners.  Its state (stage, its start time and value) is history, as for
 * Branches: corners and commands lead to the next stage.
 */
class MotionLaw
{
public:
  virtual ~MotionLaw() = default;

  virtual int              n_history() const { return 0; }
  virtual void             start(double t, double *history) const { (void)t, (void)history; }
  virtual PrescribedMotion at(double t, const double *history) const = 0;

  /// Corners are guards like those of Branches.
  virtual int                n_guards(const double *history) const { return (void)history, 0; }
  virtual std::vector<Guard> guards(const double *history) const { return (void)history, std::vector<Guard>{}; }
  virtual void guard_values(double t, const double *history, double *g) const { (void)t, (void)history, (void)g; }
  /// Continues after the corner of guard i at t.
  virtual void transition(int i, double t, double *history) const { (void)i, (void)t, (void)history; }
  /// Executes a command of a switch ("brake") at t; false: the law does not accept it.
  virtual bool                     command(const SwitchCommand &order, double t, double *history) const;
  virtual std::vector<std::string> commands() const { return {}; }
  /// @throws std::invalid_argument if the values of one of these commands are invalid
  virtual void check_order(const SwitchCommand &) const {}
};

/**
 * Constant speed until the command "brake", then a given decrease of the speed v_0 to zero, then rest:
 *
 *     f' = v_0 w(tau/T),     f'' = v_0 w'(tau/T)/T,     tau = t - t_brake
 *
 * with w(s) = 1 - s (linear), (1 + cos pi s)/2 (cosine), or ramps of length T each that start at delays t_i and reduce
 * the speed by shares A_i (shaped; sum A_i = 1), whose starts and ends are corners.
 *
 * Source: docs/theory/joints.md, prescribed motion.
 */
class BrakedMotion : public MotionLaw
{
public:
  enum class Family
  {
    linear,
    cosine,
    shaped
  };
  struct Ramp
  {
    double share, delay; ///< A_i [1], t_i [s]
  };
  struct Parameters
  {
    double            speed    = 0.; ///< v_0 [m/s or rad/s]
    Family            family   = Family::linear;
    double            duration = 0.; ///< T [s], > 0
    std::vector<Ramp> ramps;         ///< of `shaped`
  };

  /// @throws std::invalid_argument for a duration that is not positive, or shares whose sum is not one
  explicit BrakedMotion(const Parameters &parameters);

  int n_history() const override
  {
    return 3;
  } ///< corners passed since the command; t_brake, before it t_start; f there
  void                     start(double t, double *history) const override;
  PrescribedMotion         at(double t, const double *history) const override;
  int                      n_guards(const double *history) const override { return brakes(history) ? 1 : 0; }
  std::vector<Guard>       guards(const double *history) const override;
  void                     guard_values(double t, const double *history, double *g) const override;
  void                     transition(int i, double t, double *history) const override;
  bool                     command(const SwitchCommand &order, double t, double *history) const override;
  std::vector<std::string> commands() const override { return {"brake"}; }
  void                     check_order(const SwitchCommand &order) const override;

private:
  bool brakes(const double *history) const; ///< and there is a later corner

  Parameters          parameters_;
  std::vector<double> corners_; ///< [s] after t_brake, ascending; the last one ends the motion
};

/// f(t), the integral of a speed from t_start, that follows a profile and accepts commands; its corners are events
/// "next_segment".
class ProfileMotion : public MotionLaw
{
public:
  /// @param speed  [m/s or rad/s], a level or a profile
  /// @throws std::invalid_argument if it jumps, which no finite force can cause
  explicit ProfileMotion(const CommandedProfile &speed);

  int                n_history() const override { return 1 + speed_.n_history(); } ///< constant of the integral
  void               start(double t, double *history) const override;
  PrescribedMotion   at(double t, const double *history) const override;
  int                n_guards(const double *history) const override { return speed_.n_guards(history + 1); }
  std::vector<Guard> guards(const double *history) const override { return speed_.guards(history + 1); }
  void               guard_values(double t, const double *history, double *g) const override;
  void               transition(int i, double t, double *history) const override;

  bool                     command(const SwitchCommand &order, double t, double *history) const override;
  std::vector<std::string> commands() const override; ///< "start" if it waits for this command
  void                     check_order(const SwitchCommand &order) const override;

private:
  CommandedProfile speed_;
};

/// f(t) by a formula or a table of time, whose kinks are events.
class FunctionMotion : public MotionLaw
{
public:
  explicit FunctionMotion(PositionFunction f) : f_(std::move(f)) {}

  int              n_history() const override { return f_.n_history(); }
  void             start(double t, double *history) const override { f_.start(t, 1., history); }
  PrescribedMotion at(double t, const double *history) const override
  {
    const auto f = f_.at(t, history);
    return {f.value, f.first, f.second};
  }
  int                n_guards(const double *) const override { return f_.n_guards(); }
  std::vector<Guard> guards(const double *history) const override { return f_.guards(history); }
  void guard_values(double t, const double *history, double *g) const override { f_.guard_values(t, history, g); }
  void transition(int i, double t, double *history) const override { f_.transition(i, t, 1., history); }

private:
  PositionFunction f_;
};

} // namespace gestell::mechanism
