#pragma once

#include "coupling/integration/method_options.h"
#include "coupling/integration/system/second_order_system.h"

#include <Eigen/Core>

#include <atomic>
#include <map>
#include <stdexcept>
#include <string>

namespace gestell::coupling
{

/**
 * What is to repeat (5.5.4/1):
 *
 *     q(t_0 + T) = q(t_0) + turn,     q'(t_0 + T) = q'(t_0),
 *
 * turn [n] being increments of angles that leave all equations as they are, and zero for all else.  Where nothing
 * depends on the time, T is unknown too, and the coordinate `phase` is given at t_0 instead: q_phase(t_0) =
 * phase_value.
 *
 * A shift along the columns F of `free` changes no equation.  The motion along them is free,
 *
 *     q(t_0 + T) = q(t_0) + turn + F s,     s = F^T (q(t_0 + T) - q(t_0) - turn),
 *
 * and keeps the F^T q(t_0) with which a search begins.  F does not change the phase. The history of elements is reset
 * at t_0 and in every period, as when a press is fed.
 */
struct PeriodicProblem
{
  SecondOrderSystem *system = nullptr;
  double             begin  = 0.; ///< t_0 [s]
  double             period = 0.; ///< T [s]; a first guess where it is unknown
  int                ratio  = 1;  ///< T in periods of the excitation: of a subharmonic motion above 1
  Eigen::VectorXd    turn;        ///< [n] [rad]
  Eigen::MatrixXd    free;        ///< F [n x k], orthonormal; empty: there are none
  int                phase       = -1;
  double             phase_value = 0.;    ///< [rad] or [m]
  bool               phase_falls = false; ///< of an oscillation: it passes its value downwards

  const std::atomic<bool> *stop       = nullptr; ///< ends a search
  long                     most_steps = 1000000; ///< of one period: more is a motion astray

  bool interrupted() const { return stop && stop->load(std::memory_order_relaxed); }

  bool period_is_unknown() const { return phase >= 0; }
  bool has_free_shifts() const { return free.cols() > 0; }

  /// The same by the period of the excitation.
  PeriodicProblem of_one_period() const
  {
    PeriodicProblem one = *this;
    one.period /= ratio;
    one.turn /= ratio;
    one.ratio = 1;
    return one;
  }
};

/// Options of all methods, and of single ones.
struct PeriodicOptions
{
  double        tolerance   = 1e-10; ///< of PeriodicSolution::residual
  int           iterations  = 40;    ///< of Newton's method
  MethodOptions integration = options_of("exact", 8).with("force", "collocation");
  int           segments    = 0;   ///< M of multiple shooting; 0: 8, then 32 if single shooting fails
  int           periods     = 500; ///< most of them that settling integrates

  std::map<std::string, double> own; ///< given ones of those that methods declare (PeriodicMethod::options()), by name

  double value(const std::string &name, double usual) const
  {
    const auto found = own.find(name);
    return found == own.end() ? usual : found->second;
  }
};

/// There is no such solution, or the method does not reach it; the message gives the location and an alternative.
struct NoPeriodicMotion : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/// A search was interrupted.
struct SearchInterrupted : NoPeriodicMotion
{
  SearchInterrupted() : NoPeriodicMotion("interrupted") {}
};

} // namespace gestell::coupling
