#pragma once

#include "coupling/integration/system/second_order_system.h"

#include <utility>
#include <vector>

namespace gestell::coupling
{

class StateArchive;

/**
 * Norm of the error of a motion, as one number in units of the tolerance; for any integrator.
 *
 * Metres, radians and modal coordinates are made comparable by mass, m_i = M_ii: |x|^2 = sum m_i x_i^2 is the kinetic
 * energy's norm (its diagonal, which costs n multiplications instead of a product with M).  Coordinates that the base
 * system does not couple, directly or through others, form separate groups: a shaft that makes a thousand revolutions
 * gives no scale for the frame it excites.  In each group the error is
 *
 *     e_q / E,   e_v / V,     V = max |v - v_begin|,     E = min(max |q - q_begin|, V / omega_1),
 *
 * with the maxima over the motion so far.  The second bound of E is the distance in the time scale of the slowest
 * elastic mode of the base system: a free rotation has no largest excursion.  The same applies to every measure u_j
 * alone, because forces depend on measures, and contacts deform by a thousandth of the motion of their sides:
 *
 *     e_u / U_j,   e_u' / U'_j,     U_j not below 1e-3 of the excursions of the coordinates it is made of.
 *
 * The error is taken per distance travelled: each ratio is divided by chi, the part of its range that the motion covers
 * in the step, chi = min(1, max(h V / E, |v(t + h) - v(t)| / V)).  The sum of such errors is below the tolerance times
 * the number of times that the motion covers its range, for any number of steps: global errors are proportional to the
 * tolerance.  A method of order k has an error of order h^k in this norm.
 *
 * Bodies at rest have no scale of their own, and for bodies that others accelerate, u ~ t^4, t^6, the relative error is
 * large for any step.  Therefore the scale of a group or a measure is at least 1e-6 of that of the group with the
 * largest motion or, also in the energy norm, of the motion predicted from future loads (expect()).
 *
 * A virtual coordinate z has no mass.  It follows its law, T z' + z = p, and inherits the errors allowed for the
 * measures of the law: the scale of z is at least 1e-3 (sum_k |dp/du_k| U_k + |dp/du'_k| U'_k), that of z' this value
 * divided by T.
 *
 * Rounding errors are ignored: scales are at least rounding / tolerance times |q|, |v|, the separate effects of forces
 * that balance each other, and the numbers whose difference a joint or a force depends on: l - l cos(phi) does not
 * resolve angles below 1e-8.  Joints are satisfied in positions, so that their rounding r becomes r/h in rates, and a
 * law with dp/du' moves its virtual coordinate by  h/(T + h) |dp/du'| r/h  in a step.  In accelerations it is r/h^2: a
 * force with dp/du'' transmits r of one of its measures to the others as 1/m |dp/du''| r, for any step.
 */
class ErrorScale
{
public:
  using Vector = Eigen::Ref<const Eigen::VectorXd>;

  /// q, v [n], u, u' [n_u] of an instant, or of an error.
  struct Motion
  {
    Vector q, v, u, u_rate;
  };

  /// @param spectrum   of the system: its slowest elastic mode
  /// @param tolerance  with which errors are compared, > 0
  ErrorScale(const SecondOrderSystem &system, const std::vector<SpectrumLine> &spectrum, double tolerance);

  /// Starts the motion.
  void begin(const Motion &at);

  /// Sets the motion predicted from future loads: distance and speed, sqrt(sum m_i x_i^2), in a short part of the run.
  void expect(double way, double speed);
  /// Sets dp/du, dp/du' [n_u x n_u] of the laws, when they change.
  void laws(const Eigen::MatrixXd &dp_du, const Eigen::MatrixXd &dp_dv);
  /// Sets the motion for forces that depend on accelerations, which transmit the rounding errors of joints.
  void inertia(const LocalState &at);

  /// Computes the error scales for a step of length h [s] from `from` to `to` at t.
  /// @param moved  [n_u] motion of the measures by local forces alone in the step: a constraint force leaves the
  ///               rounding error of the motion it prevents
  /// @return false if `to` is not finite
  bool consider(double t, double h, const Motion &from, const Motion &to, const Vector &moved);
  /// Accepts the step last considered: its excursions are included from now on.
  void accept();
  /// It is rejected. It predicts the size of the motion at its end, a lower bound of the scales until then: a motion
  /// from rest, like t^3, would otherwise have no step small enough. Do not call it for a step whose solution is not
  /// close to a motion.
  void refuse();

  /// Error relative to the scales of the step last considered, divided by chi; the largest of all groups and measures.
  double error(const Motion &e) const;
  /// Error of the measures alone, if the coordinates follow from them exactly.
  double error_of_measures(const Vector &e_u, const Vector &e_rate) const;
  /// Coordinate with the largest contribution to the error e, for messages: "q3", or "the force on q3".
  std::string worst(const Motion &e) const;

  void exchange(StateArchive &archive); ///< data collected from the motion and the laws

  /// Number of coordinates without mass; their errors are included only through measures and neighbours.
  int massless() const { return massless_; }

private:
  /// Of a group or a measure: distance and speed so far, the change of its speed in the step, its size and rate now.
  struct Excursion
  {
    double way, speed, change_of_speed, size, rate;
  };
  using Inverse = std::pair<double, double>; ///< 1 / scale of displacements and of velocities; 0: no error

  /// Measure of a virtual coordinate, its time constant [s], and its law's slopes by u and u' [n_u].
  struct Virtual
  {
    int             measure;
    double          time, part; ///< part: 1/c of  b z' + c z = p
    Eigen::VectorXd by_u, by_rate;
  };
  /// Coordinates first .. first + size - 1 belong to one group.
  struct Run
  {
    int first, size, group;
  };
  /// Largest excursions of each group, and of each measure.
  struct Excursions
  {
    Eigen::VectorXd q, v, u, u_rate; // [groups], [groups], [n_u], [n_u]
    Eigen::VectorXd end_q, end_v;    // of the coordinates that measures consist of [n_ends]
  };

  static constexpr Eigen::VectorXd Excursions::*all[] = {&Excursions::q,      &Excursions::v,     &Excursions::u,
                                                         &Excursions::u_rate, &Excursions::end_q, &Excursions::end_v};

  static void copy(const Excursions &from, Excursions &to);
  void        find_masses();
  void        find_groups();
  void        find_ends();
  void        find_noise();
  void        find_noise_of_joints();
  void        spread(Eigen::VectorXd &noise, std::vector<double> &of_groups) const;
  double      energy(const Vector &x, const Vector *from, std::vector<double> &sums) const;
  Inverse     invert(double h, const Excursion &of) const;
  void        set_scales_of_virtual(double h);
  void        set_scales(double h, const Motion &from, const Motion &to, const Vector &moved);

  const SecondOrderSystem    &system_;
  double                      tolerance_, omega_1_, omega_n_;
  int                         massless_ = 0, n_groups_ = 0;
  std::vector<Run>            runs_;
  Eigen::VectorXd             m_;         ///< [n]
  Eigen::SparseMatrix<double> ends_;      ///< |W| for the coordinates that measures consist of [n_ends x n_u]
  std::vector<int>            end_index_; ///< those coordinates
  std::vector<int>            end_group_; ///< and their groups
  std::vector<Virtual>        virtual_;   ///< their rates follow from them and are rounding in short steps: ignored
  Eigen::VectorXd             root_mass_; ///< (W^T diag(1/m) W)_jj^-1/2: energy norm of a unit of measure u_j [n_u]
  Eigen::VectorXd     noise_;       ///< size of the numbers that cause rounding in the measures, times the terms [n_u]
  Eigen::VectorXd     joint_noise_; ///< the same for joints only: in a step their rounding is in u, and 1/h of it in u'
  Eigen::VectorXd     q_begin_, v_begin_, u_begin_, rate_begin_;
  Excursions          accepted_, reached_; ///< before and after the step considered
  Excursions          expected_, scale_;   ///< of a rejected step; reached or expected
  double              t_ = 0., expected_until_ = 0.;
  double              loads_way_ = 0., loads_speed_ = 0.; ///< of expect()
  Eigen::VectorXd     way_, speed_, size_, rate_;         ///< U, U' of the measures, and their sizes and rates [n_u]
  Eigen::VectorXd     inverse_q_, inverse_v_, inverse_u_, inverse_rate_; ///< 1 / (scale chi)
  std::vector<double> noise_of_groups_;                                  ///< as noise_, in the energy norm [groups]
  mutable std::vector<double> sums_, sums_v_, changes_, moved_;          // [groups]
};

/// Frequency [rad/s] of the slowest elastic mode of a spectrum; infinite if there is none.
double slowest_elastic(const std::vector<SpectrumLine> &spectrum);

} // namespace gestell::coupling
