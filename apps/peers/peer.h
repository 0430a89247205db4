#pragma once

#include "coupling/integration/system/second_order_system.h"
#include "coupling/integration/system/time_integrator.h"

#include <atomic>
#include <string>
#include <vector>

namespace gestell::peers
{

/// General-purpose integrators with which the methods of this program are compared.
enum class PeerKind
{
  cvode_bdf,   ///< CVODE, BDF with variable step and order 1..5
  cvode_adams, ///< CVODE, Adams-Moulton with variable step and order 1..12, its equation solved by Newton too
  ida,         ///< IDA, BDF of order 1..5 on M v' + B v + C q = f + W p, without inverting a mass matrix
  explicit_rk, ///< ARKODE, explicit embedded Runge-Kutta of order 3 (Bogacki-Shampine), 4 (Zonneveld), 5
               ///< (Dormand-Prince), 6 (Verner) or 8 (Fehlberg)
  petsc_bdf,   ///< PETSc TS, BDF of fixed order 1..6 with variable step, on the equations of IDA
  petsc_alpha  ///< PETSc TS, generalised alpha for second order, spectral radius 0.8, fixed step: its error
               ///< control measures displacements and velocities with one tolerance
};

/// Solution of the linear equations in Newton's iteration.
enum class PeerSolver
{
  condensed, ///< with SecondOrderSystem::factorise(1, gamma, gamma^2) and the local tangent as update of low rank
  dense      ///< the library's own LU of the analytic Jacobian [2 n x 2 n]
};

/// Vector operations of the library.
enum class PeerVectors
{
  library, ///< its own loops as distributed, with fused operations
  native   ///< loops compiled for this processor like the rest of the program
};

/// Initial state of the comparison, and the scales of its coordinates.
struct PeerProblem
{
  double                   t = 0.;
  Eigen::VectorXd          q, v;             ///< [n] at t
  Eigen::VectorXd          q_scale, v_scale; ///< [n] > 0: absolute tolerance = relative tolerance * scale
  std::vector<double>      samples;          ///< ascending, >= t: instants at which q, v are requested
  const std::atomic<bool> *stop = nullptr;   ///< set: the run is aborted
};

struct PeerOptions
{
  PeerKind    kind      = PeerKind::cvode_bdf;
  int         order     = 5; ///< highest order used; explicit_rk: 3, 4, 5, 6 or 8
  PeerSolver  solver    = PeerSolver::condensed;
  PeerVectors vectors   = PeerVectors::library;
  double      tolerance = 1e-4;  ///< relative: error weights are tolerance (|y_i| + scale_i)
  double      step      = 0.;    ///< [s] of petsc_alpha; the others choose their steps
  bool        events    = false; ///< located by the library's root finding, with a restart there; else skipped
  double      cpu_limit = 60.;   ///< [s]; longer runs are aborted
};

/// The motion at one instant, with the history of the elements on which the forces depend.
struct MotionSample
{
  double          t;
  Eigen::VectorXd q, v, history;
  Eigen::VectorXd p; ///< forces of the elements
};

struct PeerResult
{
  std::vector<MotionSample> samples; ///< up to the end of the run
  coupling::IntegrationWork work;    ///< evaluations: of the right-hand side or the residual
  long                      events  = 0;
  double                    cpu_s   = 0.; ///< of the stepping thread, from its first step to the last sample
  double                    setup_s = 0.; ///< [s] of setup in this thread
  std::string               failure;      ///< not empty: reason for an early end
};

/// "CVODE BDF 5, condensed", "IDA 5, dense", "ARKODE explicit 8"
std::string peer_name(const PeerOptions &options);

/// False if this build has no SUNDIALS; run_peer() then throws std::invalid_argument.
bool peers_available();

/// False if the plugin with PETSc was not built; run_peer() then throws std::invalid_argument for its kinds.
bool petsc_available();

/// The version of the library, "SUNDIALS 6.4.1"; empty without it.
std::string peer_version();

/**
 * Integrates a system with a general-purpose library in the first-order form y = (q, v), v = q':
 *
 *     q' = v,     M v' = f_t + W p - B v - C q          (M regular)
 *
 * A sticking measure has u'' = 0, and its force follows from this condition.
 *
 * @throws std::invalid_argument for options outside their range, wrong sizes or a singular M
 */
PeerResult run_peer(coupling::SecondOrderSystem &system, const PeerProblem &problem, const PeerOptions &options);

/// CPU time of the calling thread [s].
double thread_seconds();

} // namespace gestell::peers
