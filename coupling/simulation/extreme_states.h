#pragma once

#include "coupling/integration/system/time_integrator.h"

#include <Eigen/Core>

#include <vector>

namespace gestell::coupling
{

struct SignalSummary;

/// Where a signal is largest or smallest.
struct SignalExtreme
{
  int  signal  = -1; ///< number
  bool largest = true;
};

/// States of a run that are kept for what is computed from them afterwards, stresses for instance.
struct StateRequest
{
  double                     step = 0.; ///< [s] of a grid from the begin of the run; 0: none
  std::vector<double>        at;        ///< [s] instants, ascending
  std::vector<SignalExtreme> extremes;

  bool empty() const { return !(step > 0.) && at.empty() && extremes.empty(); }
};

struct KeptState
{
  double          t = 0.;
  Eigen::VectorXd q; ///< empty: the run did not come so far
};

struct KeptStates
{
  std::vector<KeptState> grid, at, extremes; ///< the last two as in the request
};

/// Takes the wanted states from the dense output, where they lie, not from the steps beside them.  Without a request a
/// step costs one comparison.
class ExtremeStates
{
public:
  ExtremeStates(const TimeIntegrator &integrator, const StateRequest &request, double begin,
                const std::vector<SignalSummary> &signals, KeptStates &kept);

  /// At the start, after a step and after an event, when the extremes of the signals are known.
  void follow();

private:
  Eigen::VectorXd state(double t);

  const TimeIntegrator             &integrator_;
  const StateRequest               &request_;
  const std::vector<SignalSummary> &signals_;
  KeptStates                       &kept_;
  bool                              idle_;
  double                            begin_;
  std::size_t                       next_at_ = 0;
  Eigen::VectorXd                   q_, v_;
};

} // namespace gestell::coupling
