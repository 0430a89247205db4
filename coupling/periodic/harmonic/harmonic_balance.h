#pragma once

#include "coupling/periodic/harmonic/base_response.h"
#include "coupling/periodic/harmonic/harmonic_forces.h"
#include "coupling/periodic/periodic_solution.h"

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace gestell::coupling
{

/**
 * Harmonic balance (Ritz-Galerkin, 5.5.4), condensed to the measures u = W^T q: the equations for the coefficients of
 * exp(i h omega (t - t_0)), h = 0 ... H,
 *
 *     u_h - R_h p_h(u) - u0_h - [h = 0] U_y y = 0,     P_y p_0 + l = 0,     q_phase(t_0) = phase_value,
 *
 * of which the second holds for motions without stiffness, whose mean displacements y are unknowns (see BaseResponse),
 * and the third where the period is one.  The unknowns are
 *
 *     z = (c_0, c_1, s_1, ... c_H, s_H; y; T)   [n_u (2 H + 1) + n_y + (0 or 1)],   c_h, s_h of cos, sin h omega (t -
 * t_0).
 *
 * The modes of the base are only in R_h, computed once for each omega.
 */
class HarmonicBalance
{
public:
  /// @param samples of a period; 0: by the laws, see HarmonicForces
  /// @throws std::invalid_argument as BaseResponse and HarmonicForces do
  HarmonicBalance(const PeriodicProblem &problem, int harmonics, int samples = 0);

  int  size() const { return size_; }
  bool period_is_unknown() const { return problem_.period_is_unknown(); }
  bool interrupted() const { return problem_.interrupted(); }
  int  harmonics() const { return harmonics_; }
  int  samples() const { return forces_->samples(); }
  int  largest_load() const { return base_.largest_load(); } ///< highest harmonic of the load

  /// @throws std::invalid_argument for loads above H
  void require_load() const;

  /// Another number of harmonics; the modes of the base stay.
  void set_harmonics(int harmonics, int samples = 0);

  double period() const { return period_; }
  /// Of a continuation in the speed of the drive: harmonics of the load remain what they are of the period.
  void set_period(double period);

  /// The linear response without elements.
  Eigen::VectorXd linear_start();
  /// One harmonic through the state q, v [n] at t_0, about the mean of the linear response.
  Eigen::VectorXd start_through(const Eigen::VectorXd &q, const Eigen::VectorXd &v);
  /// The unknowns of a known motion, truncated or padded to H harmonics.
  Eigen::VectorXd pack(const FourierSeries &motion) const;

  /// The unknowns (or a change of them) of `harmonics` harmonics with zeros for those above.
  Eigen::VectorXd filled_up(const Eigen::VectorXd &z, int harmonics) const;

  /// r(z) [size], each in the unit of the unknown at its place.
  void residual(const Eigen::VectorXd &z, Eigen::VectorXd &r);
  /// The same with dr/dz.
  void linearise(const Eigen::VectorXd &z, Eigen::VectorXd &r, Eigen::MatrixXd &J);
  /// dr/dT at fixed coefficients; explicit times in laws not counted.
  Eigen::VectorXd period_slope(const Eigen::VectorXd &z);
  /// A size of each unknown: the amplitude of its measure, of z as a whole where that rests.
  Eigen::VectorXd scales(const Eigen::VectorXd &z) const;
  /// The same; for measures that turn at least their turn in a period, of which rounding is a share.
  Eigen::VectorXd scales_of_rounding(const Eigen::VectorXd &z) const;

  /// Truncation error of H harmonics.
  struct LeftOut
  {
    double motion = 0.; ///< that forces above harmonic H would add, |sum_{h>H} R_h p_h| / |u|, of what moves most of it
    double forces = 0.; ///< largest change of a force that this motion makes, of its range
    double samples = 0.; ///< share of `motion` that comes from too few samples of the forces
  };
  LeftOut left_out(const Eigen::VectorXd &z);
  /// Whether laws have hysteresis, and its share of the force.
  HarmonicForces::Memory memory(const Eigen::VectorXd &z);

  /// All coordinates, in the time t itself.
  FourierSeries series(const Eigen::VectorXd &z);
  /// q, q' [n] at t_0.
  void state_at_begin(const Eigen::VectorXd &z, Eigen::VectorXd &q, Eigen::VectorXd &v);

  /// Spectra of the derivatives at the z of the last linearise().
  const std::vector<HarmonicForces::Derivative> &derivatives() const { return forces_->derivatives(); }

private:
  Eigen::MatrixXcd coefficients_of(const Eigen::VectorXd &z) const;
  Eigen::MatrixXcd displacements(const Eigen::VectorXd &z);
  void             put(int h, const Eigen::VectorXcd &u, Eigen::VectorXd &z) const;
  void             use(const Eigen::VectorXd &z);
  void             balance(const Eigen::VectorXd &z, Eigen::VectorXd &r) const;
  void             fill_block(const ForceBlock &block, Eigen::MatrixXd &J) const;
  Eigen::VectorXd  omega_slope() const;
  Eigen::VectorXd  free_of(const Eigen::VectorXd &z) const { return z.segment(first_free(), n_free_); }
  int              first_free() const { return n_u_ * (2 * harmonics_ + 1); }

  PeriodicProblem                 problem_;
  BaseResponse                    base_;
  std::unique_ptr<HarmonicForces> forces_;
  int                             harmonics_ = 0, n_u_ = 0, n_free_ = 0, size_ = 0;
  double                          period_, formed_ = 0.; ///< [s]; [rad/s] that R_h are formed for, 0: for none
  bool                            formed_with_slopes_ = false;
};

/// @throws std::invalid_argument if the harmonics of all measures are too many unknowns
void require_unknowns(const PeriodicProblem &problem, int harmonics);

} // namespace gestell::coupling
