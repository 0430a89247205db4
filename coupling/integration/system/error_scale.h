#pragma once

#include "coupling/integration/system/second_order_system.h"

#include <utility>
#include <vector>

namespace gestell::coupling
{

class StateArchive;

/**
 * How large an error of a motion is, as one number in the units of the tolerance; for any integrator.
 *
 * Metres, radians and modal coordinates are made comparable by mass, m_i = M_ii: |x|^2 = sum m_i x_i^2 is the kinetic
 * energy's norm (its diagonal, which costs n multiplications instead of a product with M).  Coordinates that the base
 * system does not couple, directly or through others, form groups of their own: a shaft that turns a thousand times
 * says nothing about the frame it shakes.  In each group
 *
 *     e_q / E,   e_v / V,     V = max |v - v_begin|,     E = min(max |q - q_begin|, V / omega_1),
 *
 * with the maxima over the motion so far.  The second bound of E is the way gone in the time of the slowest elastic
 * mode of the base system: a free rotation has no largest excursion.  The same for every measure u_j alone, because
 * forces depend on measures, and a contact moves a thousandth of what its two sides move:
 *
 *     e_u / U_j,   e_u' / U'_j,     U_j not below 1e-3 of the excursions of the coordinates it is made of.
 *
 * What counts is the error for the way gone: each ratio is divided by chi, the part of its range that the motion passes
 * in the step, chi = min(1, max(h V / E, |v(t + h) - v(t)| / V)).  A sum of such errors stays below the tolerance times
 * the number of times the motion goes through its range, however many steps that takes: global errors are proportional
 * to the tolerance.  A method of order k has an error of order h^k in this measure.
 *
 * Bodies at rest have no scale of their own, and the motion of those that others set in motion, u ~ t^4, t^6, is small
 * against itself with no step.  So neither a group nor a measure counts for less than 1e-6 of the group that moves most
 * or, in the energy norm too, of the motion that the loads to come would bring (expect()).
 *
 * A virtual coordinate z has no mass.  It follows its law, T z' + z = p, and with the law the errors that its measures
 * may have: z does not count for less than 1e-3 (sum_k |dp/du_k| U_k + |dp/du'_k| U'_k), nor z' than that per T.
 *
 * Errors that rounding explains do not count: scales are not below rounding / tolerance times |q|, |v|,
 * what forces that balance each other would do alone, and the numbers whose difference a joint closes or a force
 * depends on: l - l cos(phi) knows an angle below 1e-8 no more.  Joints close positions, so that rounding r of these is
 * r/h in rates, and a law with dp/du' moves its virtual coordinate by  h/(T + h) |dp/du'| r/h  in a step.  It is r/h^2
 * in accelerations: a force with dp/du'' takes r of one of its measures, whatever the step, to the others, 1/m
 * |dp/du''| r.
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

  /// The motion begins here.
  void begin(const Motion &at);

  /// Loads to come would lead that far and make it that fast, sqrt(sum m_i x_i^2), in a short part of the run.
  void expect(double way, double speed);
  /// dp/du, dp/du' [n_u x n_u] of the laws, where they change.
  void laws(const Eigen::MatrixXd &dp_du, const Eigen::MatrixXd &dp_dv);
  /// Forces that depend on accelerations, as they do at this motion, carry what rounding joints leave.
  void inertia(const LocalState &at);

  /// A step of length h [s] would lead from `from` to `to` at t: the scales for its errors.
  /// @param moved  [n_u] how far local forces alone move the measures in the step: a force that holds a body leaves
  ///               rounding of what it holds it back
  /// @return false if `to` is not finite
  bool consider(double t, double h, const Motion &from, const Motion &to, const Vector &moved);
  /// The step last considered is taken: its excursions count from now on.
  void accept();
  /// It is rejected. It predicts the size of the motion at its end, a lower bound of the scales until then: a motion
  /// from rest, like t^3, would otherwise have no step small enough. Do not call it for a step whose solution is not
  /// close to a motion.
  void refuse();

  /// Error relative to the scales of the step last considered, per chi; the largest of all groups and measures.
  double error(const Motion &e) const;
  /// Of the measures alone, where the coordinates follow from them exactly.
  double error_of_measures(const Vector &e_u, const Vector &e_rate) const;
  /// Coordinate with the largest part in the error e, for messages: "q3", or "the force on q3".
  std::string worst(const Motion &e) const;

  void exchange(StateArchive &archive); ///< what was seen of the motion and of the laws

  /// n [1] of coordinates without mass; their errors count through measures and neighbours alone.
  int massless() const { return massless_; }

private:
  /// Of a group or a measure: how far and how fast it has gone, the change of its speed in the step, its size and rate
  /// now.
  struct Excursion
  {
    double way, speed, change_of_speed, size, rate;
  };
  using Inverse = std::pair<double, double>; ///< 1 / scale of displacements and of velocities; 0: no error

  /// A virtual coordinate's measure, its time constant [s], and by how much its law follows others, per u and u' [n_u].
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
    Eigen::VectorXd end_q, end_v;    // of the coordinates that measures are made of [n_ends]
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
  Eigen::SparseMatrix<double> ends_;      ///< |W| on the coordinates that measures are made of [n_ends x n_u]
  std::vector<int>            end_index_; ///< those coordinates
  std::vector<int>            end_group_; ///< and their groups
  std::vector<Virtual>        virtual_;   ///< their rates follow from them and are rounding in short steps: not judged
  Eigen::VectorXd     root_mass_; ///< (W^T diag(1/m) W)_jj^-1/2: a measure u_j moves the energy norm by that [n_u]
  Eigen::VectorXd     noise_; ///< of the numbers that leave rounding in the measures, times the number of terms [n_u]
  Eigen::VectorXd     joint_noise_; ///< of those that joints close alone: a step leaves it in u, and 1/h of it in u'
  Eigen::VectorXd     q_begin_, v_begin_, u_begin_, rate_begin_;
  Excursions          accepted_, reached_; ///< before and after the step that is considered
  Excursions          expected_, scale_;   ///< of a step refused; reached or expected
  double              t_ = 0., expected_until_ = 0.;
  double              loads_way_ = 0., loads_speed_ = 0.; ///< of expect()
  Eigen::VectorXd     way_, speed_, size_, rate_;         ///< U, U' of the measures, and the numbers they are of [n_u]
  Eigen::VectorXd     inverse_q_, inverse_v_, inverse_u_, inverse_rate_; ///< 1 / (scale chi)
  std::vector<double> noise_of_groups_;                                  ///< as noise_, in the energy norm [groups]
  mutable std::vector<double> sums_, sums_v_, changes_, moved_;          // [groups]
};

/// Frequency [rad/s] of the slowest elastic mode of a spectrum; infinite if there is none.
double slowest_elastic(const std::vector<SpectrumLine> &spectrum);

} // namespace gestell::coupling
