#pragma once

#include "coupling/periodic/base_receptance.h"
#include "coupling/periodic/periodic_problem.h"

#include <Eigen/Core>

#include <complex>
#include <vector>

namespace gestell::coupling
{

/**
 * The response of the linear base system at the harmonics of a period, in its measures u = W^T q and, for an unknown
 * period, the coordinate that fixes the phase.  With coefficients of exp(i h omega (t - t_0)),
 *
 *     u_h = R_h p_h + u0_h,     R_h = W^T D(i h omega)^-1 W,     D(s) = s^2 M + s B + C,
 *
 * from the modes (BaseReceptance): m operations for a harmonic and a pair of measures, and no unknowns.
 *
 * Motions without stiffness make D(0) singular.  Their mean displacements y are unknowns, with the balance of mean
 * forces as additional equations:
 *
 *     u_0 = R_0 p_0 + u0_0 + U_y y,     0 = P_y p_0 + l.
 *
 * Where coordinates turn by `turn` in a period, q = turn (t - t_0)/T + series; the motion of constant speed acts
 * through B.
 */
class BaseResponse
{
public:
  /// @throws std::invalid_argument: the load is not a sum of harmonics of the period, the base constrains a rotating
  /// coordinate, or the modes are not found; the message gives reason and remedy
  explicit BaseResponse(const PeriodicProblem &problem);

  int n_measures() const { return n_u_; }
  int n_rows() const { return n_rows_; } ///< measures, then the coordinate of the phase
  int n_free() const { return static_cast<int>(free_.size()); }
  int largest_load() const; ///< highest harmonic of the load

  using Slopes = BaseReceptance::Slopes;
  /// Forms R_h, u0_h for h = 0 ... H at omega [rad/s], and their derivatives by omega if requested.
  /// @throws std::invalid_argument if an undamped mode coincides with a harmonic
  void form(double omega, int harmonics, Slopes slopes);

  Eigen::MatrixXcd        R(int h) const { return base_.R(h); }             ///< [n_rows x n_u]
  Eigen::MatrixXcd        R_slope(int h) const { return base_.R_slope(h); } ///< over omega [s/rad]
  const Eigen::VectorXcd &u0(int h) const { return forced_[h]; }            ///< [n_rows]
  const Eigen::VectorXcd &u0_slope(int h) const { return forced_slope_[h]; }

  const Eigen::MatrixXd &free_columns() const { return free_columns_; }   ///< U_y [n_rows x n_free]
  Eigen::MatrixXd        free_rows() const;                               ///< P_y [n_free x n_u], in the unit of y
  Eigen::VectorXd        free_loads() const;                              ///< l [n_free]
  Eigen::VectorXd        free_loads_slope(const Eigen::VectorXd &) const; ///< d(P_y p_0 + l)/d omega at p_0

  /// q_h [n] of forces p_h [n_u] and, at h = 0, of y.
  Eigen::VectorXcd displacement(int h, const Eigen::VectorXcd &p, const Eigen::VectorXd &y) const;
  /// y of the mean displacement q_0 [n].
  Eigen::VectorXd mean_of_free(const Eigen::VectorXd &q) const;

private:
  struct Load
  {
    int              harmonic; ///< h of the period
    Eigen::VectorXcd put;      ///< [2 n_modal], half the amplitude: the coefficient of exp(i h omega t)
  };
  /// The mean of state `unknown` stays unknown, the balance is that of state `equation`, of order s^power.
  struct FreeMotion
  {
    int unknown, equation, power;
  };

  void             gather_loads(const PeriodicProblem &problem);
  void             gather_free_motions();
  void             check_turn(const PeriodicProblem &problem) const;
  void             check_resonance() const;
  Eigen::VectorXcd load_at(int h) const;
  Eigen::VectorXcd solve(std::complex<double> s, const Eigen::VectorXcd &g) const;
  void             form_forced(Slopes slopes);

  ModalBlocks                   modes_;
  BaseReceptance                base_;
  int                           n_u_ = 0, n_rows_ = 0, harmonics_ = 0;
  double                        omega_ = 0., begin_ = 0.;
  Eigen::VectorXd               constant_; ///< put by the constant load [2 n_modal]
  Eigen::VectorXd               turning_;  ///< put by a ramp of turn in one radian of omega t [2 n_modal]
  std::vector<Load>             loads_;
  std::vector<FreeMotion>       free_;
  Eigen::MatrixXd               free_columns_;
  std::vector<Eigen::VectorXcd> forced_, forced_slope_;
};

} // namespace gestell::coupling
