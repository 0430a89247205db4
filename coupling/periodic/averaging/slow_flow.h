#pragma once

#include "coupling/periodic/averaging/describing_function.h"
#include "coupling/periodic/periodic_problem.h"

#include <Eigen/Core>

#include <complex>
#include <vector>

namespace gestell::coupling
{

/**
 * Slow flow of one mode (Bogoliubov, Mitropolsky), q = q_0 + phi Re(z exp(i Omega t)), |z| = a:
 *
 *     z' = [-delta(a) + i (omega(a) - Omega)] z - i f/(2 omega_0),
 *     omega(a) = omega_0 + k(a)/(2 omega_0),     delta(a) = (phi^T B phi + c(a))/2,
 *
 * phi, omega_0 being the mode of the system linearised at its equilibrium, phi^T M phi = 1, f the load of frequency
 * Omega in this mode, k and c what the describing functions of all elements have beyond the linear stiffness, and q_0
 * the mean that the mean forces keep.  Of first order in k, c, f.
 *
 * Steady motions are [(omega(a) - Omega)^2 + delta(a)^2] a^2 = (|f|/(2 omega_0))^2, free ones delta(a) = 0, and
 * omega(a) is the backbone.
 * Source: Bogoliubov, Mitropolsky, Asymptotic Methods in the Theory of Non-Linear Oscillations (1961), sections 1
 * and 14.
 */
class SlowFlow
{
public:
  /// @param mode counted from the lowest; -1: the one nearest the load, or where there is none, the one that is excited
  ///             by itself, nearest the period of the problem
  /// @throws std::invalid_argument: no such mode, more than one frequency of loads, or no equilibrium
  explicit SlowFlow(const PeriodicProblem &problem, int mode = -1);
  ~SlowFlow();
  SlowFlow(const SlowFlow &)            = delete;
  SlowFlow &operator=(const SlowFlow &) = delete;

  double                 omega_0() const { return omega_0_; } ///< [rad/s]
  const Eigen::VectorXd &shape() const { return phi_; }       ///< phi [n]
  std::complex<double>   load() const { return load_; }       ///< f; zero: none
  double                 load_omega() const { return load_omega_; }

  struct Rates
  {
    double omega, delta; ///< [rad/s], [1/s]
  };
  Rates                  at(double a);
  const Eigen::VectorXd &mean() const { return q_0_; } ///< of the last at() [n]

  /// All steady amplitudes a > 0, ascending, from `from` to `to`; both zero: about what the linear system has.
  std::vector<double> amplitudes(double from = 0., double to = 0.);
  /// The z of a steady amplitude, its phase that of the load.
  std::complex<double> steady(double a);
  /// Eigenvalues of the slow flow about it [1/s].
  Eigen::Vector2cd eigenvalues(double a);

private:
  void   find_rest();
  void   find_mode(int mode);
  void   find_load();
  void   start_moving();
  double nearness(int mode, const Eigen::VectorXd &omega, const Eigen::MatrixXd &shapes) const;
  void   settle_mean(double a);
  double balance(double a);
  double root(double below, double above);
  void   add_roots_of_dip(double from, double to, double side, std::vector<double> &found);

  const PeriodicProblem &problem_;
  Eigen::MatrixXd        M_, B_, C_, W_, linear_C_, linear_B_, flexibility_;
  Eigen::VectorXd        entry_history_, rest_, q_0_, phi_, d_;
  double                 omega_0_ = 0., linear_k_ = 0., linear_damping_ = 0., load_omega_ = 0.;
  std::complex<double>   load_ = 0.;
};

} // namespace gestell::coupling
