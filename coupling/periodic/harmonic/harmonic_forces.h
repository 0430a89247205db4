#pragma once

#include "coupling/periodic/harmonic/fourier_transform.h"
#include "coupling/periodic/periodic_problem.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace gestell::coupling
{

/**
 * Forces of the elements over a period of given motion, as Fourier coefficients, by alternating between frequency and
 * time: u(t), u'(t), u''(t) are sampled from their coefficients, p and its derivatives evaluated at the samples and
 * transformed back.  Laws follow the branch that the motion itself is in.
 *
 *     u = turn_u theta + sum_h u_h exp(2 pi i h theta),     theta = (t - t_0)/T
 *
 * N samples alias parts beyond N/2 of a law of degree k: none for N > (k + 1) H.
 *
 * Source: Cameron and Griffin, Journal of Applied Mechanics 56(1), 1989, 149-154.
 */
class HarmonicForces
{
public:
  /// Of p_i over u_j, u'_j and u''_j, coefficients of exp(i h omega (t - t_0)), h = 0 ... N/2; those of -h are their
  /// conjugates.
  struct Derivative
  {
    int              i, j;
    Eigen::VectorXcd of_u, of_v, of_a; ///< of_a is empty if p depends on no u''

    std::complex<double> at(int h, double l_omega) const; ///< of the harmonic whose factor of d/dt is i l_omega
  };

  /// @param harmonics H of the motion
  /// @param samples   0: by the laws: enough for cubic ones, more where they have branches
  /// @throws std::invalid_argument if an element sticks or has hysteresis, or for too few samples
  HarmonicForces(const PeriodicProblem &problem, int harmonics, int samples);
  ~HarmonicForces();
  HarmonicForces(const HarmonicForces &)            = delete;
  HarmonicForces &operator=(const HarmonicForces &) = delete;

  enum class With
  {
    forces,
    derivatives,
    slope ///< over omega too
  };
  /// @param u coefficients u_0 ... u_H [n_u x (H + 1)]
  void evaluate(const Eigen::MatrixXcd &u, double omega, With with);

  int                     samples() const { return transform_.samples(); }
  const Eigen::MatrixXcd &forces() const { return forces_; } ///< p_0 ... p_{N/2} [n_u x (N/2 + 1)]
  /// Error of p_0 ... p_H by kinks at these samples, by a rule of second order: a third of the difference to
  /// every other sample [n_u x (H + 1)].
  Eigen::MatrixXcd               sampling_errors() const;
  const std::vector<Derivative> &derivatives() const { return derivatives_; }
  const Eigen::MatrixXcd        &slope() const { return slope_; } ///< dp/domega at fixed u_h [n_u x (N/2 + 1)]

  /// Largest difference of the forces between an element in its initial state and after a period, relative to the
  /// largest force; above zero for laws with hysteresis.
  struct Memory
  {
    double      share = 0.;
    std::string element; ///< whose law it is
  };
  Memory memory(const Eigen::MatrixXcd &u, double omega);
  /// Largest change of each force over the period when the motion changes from u to another of up to N/2 - 1 harmonics
  /// [n_u].  @param other its coefficients [n_u x k]
  Eigen::VectorXd changes(const Eigen::MatrixXcd &u, const Eigen::MatrixXcd &other, double omega);
  Eigen::VectorXd ranges() const; ///< largest less least force of the last evaluate() [n_u]

private:
  Eigen::MatrixXd sampled(const Eigen::MatrixXcd &u, double omega); ///< forces [N x n_u]
  void            sample_motion(const Eigen::MatrixXcd &u, double omega);
  void            start_elements();
  void            set_state(int k);
  void            evaluate_sample(int k, With with);
  void            add_derivatives_over_u2(int k);
  void            gather_entries();

  const PeriodicProblem  &problem_;
  int                     harmonics_, n_u_;
  FourierTransform        transform_;
  Eigen::VectorXd         turn_u_; ///< W^T turn
  double                  omega_         = 0.;
  bool                    depends_on_u2_ = false;
  LocalState              state_;
  Eigen::VectorXd         entry_state_;                   ///< history of the elements, given back in the end
  Eigen::MatrixXd         u_, v_, a_, p_, slope_samples_; // [N x n_u]
  Eigen::MatrixXd         of_u_, of_v_, of_a_;            // [N x entries]
  Eigen::MatrixXd         dp_du_, dp_dv_, dp_da_;         // [n_u x n_u]
  Eigen::MatrixXcd        forces_, slope_;
  Eigen::VectorXcd        coefficients_;
  std::vector<Derivative> derivatives_;
};

} // namespace gestell::coupling
