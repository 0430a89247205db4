#pragma once

#include "coupling/integration/system/second_order_system.h"

#include <Eigen/Core>

namespace gestell::coupling
{

/**
 * First harmonic of the force f against a motion x = x_0 + A cos(omega t):  f ~ mean + stiffness (x - x_0) + damping
 * x'.
 *
 *     mean = 1/(2 pi) int f dphi,   stiffness = 1/(pi A) int f cos dphi,   damping = -1/(pi A omega) int f sin dphi
 */
struct DescribingFunction
{
  double mean      = 0.; ///< a_0 [N]
  double stiffness = 0.; ///< k_eq [N/m]
  double damping   = 0.; ///< c_eq [N s/m]
};

/// Closed formulas about x_0 = 0, for amplitudes A > 0 [m] and omega > 0 [rad/s], with s = gap/A.
/// Source: Gelb, Vander Velde, Multiple-Input Describing Functions (1968), appendix B; those of the friction by
/// integration.
namespace describing
{

/// k (|x| - gap) sgn x beyond the gap:  k_eq = k [1 - (2/pi) (asin s + s sqrt(1 - s^2))], zero for s > 1.
DescribingFunction play(double k, double gap, double A);
/// k_1 x and stops k_2 (|x| - gap) sgn x beyond the gap.
DescribingFunction stops(double k_1, double k_2, double gap, double A);
/// k (x - gap) for x > gap:  a_0 = (k A/pi) (sqrt(1 - s^2) - s acos s),  k_eq = (k/pi) (acos s - s sqrt(1 - s^2)).
DescribingFunction one_sided_stop(double k, double gap, double A);
/// F sgn x + k x:  k_eq = k + 4 F/(pi A).
DescribingFunction preload(double F, double k, double A);
/// beta x^3:  k_eq = 3/4 beta A^2.
DescribingFunction cubic(double beta, double A);
/// beta x^5:  k_eq = 5/8 beta A^4.
DescribingFunction quintic(double beta, double A);
/// F sgn x':  omega c_eq = 4 F/(pi A).
DescribingFunction coulomb(double F, double A, double omega);
/// F (2/pi) atan(x'/eps):  omega c_eq = (4 F/(pi A)) (sqrt(1 + r^2) - 1)/r,  r = A omega/eps.
DescribingFunction coulomb_atan(double F, double eps, double A, double omega);
/// F x'/sqrt(x'^2 + eps^2):  omega c_eq = (4 F/(pi A)) (sqrt(1 + r^2)/r) [E(m) - K(m)/(1 + r^2)],  m = r^2/(1 + r^2),
/// with the complete elliptic integrals of parameter m.
DescribingFunction coulomb_root(double F, double eps, double A, double omega);
/// c x' |x'|:  c_eq = 8/(3 pi) c A omega.
DescribingFunction quadratic_damping(double c, double A, double omega);
/// Spring k in series with a slider of limit F (Jenkins), in its steady loop:  theta = acos(1 - 2 F/(k A)),
/// k_eq = (k/pi) (theta - sin(2 theta)/2),  omega c_eq = (4 F/(pi A)) (1 - F/(k A));  k alone for A <= F/k.
DescribingFunction jenkins(double k, double F, double A, double omega);

} // namespace describing

/**
 * The same of the elements of a system, by quadrature of their own laws: measures move as u = u_0 + d A cos(omega t),
 * and f = -d^T p is the force against that motion.  Intervals are halved, about kinks to rounding, until 15 points of
 * Gauss and Kronrod agree with 7 to 1e-13 of the largest force.  Laws follow the branch of the motion itself, from the
 * histories of the system at the call.
 */
class DescribedForces
{
public:
  DescribedForces(const SecondOrderSystem &system, Eigen::VectorXd d);

  DescribingFunction     at(const Eigen::VectorXd &u_0, double A, double omega);
  const Eigen::VectorXd &mean_forces() const { return mean_; }      ///< of p in the last at() [n_u]
  double                 largest_force() const { return largest_; } ///< |p| in it

private:
  using Sums = Eigen::VectorXd; ///< int p, int d^T p cos, int d^T p sin [n_u + 2]

  Sums integrand(double phi);
  void add(double from, double to, int depth, bool twin_disagrees);
  void kronrod(double from, double to, Sums &fine, Sums &rough);

  const LocalForces &forces_;
  Eigen::VectorXd    d_, u_0_, mean_;
  double             A_ = 0., omega_ = 0., largest_ = 0.;
  LocalState         state_;
  Sums               sum_;
};

} // namespace gestell::coupling
