#pragma once

#include "coupling/periodic/collocation/collocation.h"
#include "coupling/periodic/period_flow.h"

#include <string>
#include <vector>

namespace gestell::coupling
{

/// Mesh points from the given ones: ascending, with both ends, points within 1e-9 of the period merged.
std::vector<double> mesh_of(std::vector<double> points);
/// Events of a period that began at t_0, as shares of it.
std::vector<double> event_points(const std::vector<Event> &events, double begin, double period);
/// Forces along the motion that starts at the guess, over its period, at the Gauss points of a mesh [N s n_u].
/// @throws ConvergenceFailure
Eigen::VectorXd forces_along(PeriodFlow &flow, const PeriodicGuess &start, const std::vector<double> &mesh);

/// Why a mesh cannot represent the forces of the motion that starts there: the element with hysteresis or sticking;
/// empty: it can.
std::string why_no_mesh(const PeriodicProblem &problem, PeriodFlow &flow, const PeriodicGuess &start);

/// A search by collocation on adaptive meshes, with points at the events of the motion.
class MeshSearch
{
public:
  MeshSearch(const PeriodicProblem &problem, const PeriodicOptions &options);

  PeriodFlow &flow() { return flow_; }
  /// On uniform meshes, finer where Newton's method does not converge from the guess; then halved where the error is
  /// too large.
  /// @throws NoPeriodicMotion
  /// @throws std::invalid_argument if an element has hysteresis or sticks: its force is then not a function of the
  /// motion
  void run(const PeriodicGuess &guess);
  /// What was found, with multipliers where the integrator has tangents.
  PeriodicSolution solution();

  const PeriodicCollocation &collocation() const { return collocation_; }
  const Eigen::VectorXd     &unknowns() const { return P_; }
  double                     error() const { return errors_.maxCoeff(); } ///< see PeriodicCollocation::errors()

private:
  void refuse_memory(const PeriodicGuess &start);
  void begin(const PeriodicGuess &guess);
  void solve();
  bool refine();
  void set_mesh(std::vector<double> points);

  const PeriodicProblem &problem_;
  const PeriodicOptions &options_;
  PeriodFlow             flow_;
  PeriodicCollocation    collocation_;
  std::vector<double>    grid_; ///< points but for those of events
  Eigen::VectorXd        P_, q_, v_, errors_;
  int                    iterations_ = 0;
};

/// The motion of a start with its period [s] that collocation found, followed once by the flow.
PeriodicSolution collocated(const PeriodicProblem &problem, const MethodOptions &integration, PeriodFlow &flow,
                            const PeriodicGuess &start, bool tangents);

} // namespace gestell::coupling
