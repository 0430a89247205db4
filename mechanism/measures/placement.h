#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <vector>

namespace gestell::mechanism
{

using Vector3d = Eigen::Vector3d;

/**
 * A point with directions on a body, as a function of the body's k measures u (m, rad), which are zero in the reference
 * configuration:
 *
 *     x(u) = c + sum u_i t_i + (1 + theta x) rho(phi),     theta = sum u_i r_i,     rho(phi) = R(n, phi) (x_0 - c).
 *
 * Each linear measure moves by t_i and turns by the small rotation r_i (a frame, a slide and its guide, a point); one
 * last measure may be a large angle phi about n (a rotor on its carrier; a body in a plane). Directions rotate in the
 * same way. A free spatial body has the measures (u_c, u_1, u_2, u_3), 3 numbers each, in which all is linear:
 *
 *     x(u) = x_0 + u_c + sum (x_0 - c)_i u_i,     e(u) = e + sum e_i u_i,
 *
 * with the directors d_i = e_i + u_i, along x, y, z in the reference configuration, kept rigid by OrthonormalDirectors.
 *
 * Source: kinematics of rigid bodies; docs/theory/joints.md (1), (1a).
 */
class Placement
{
public:
  static constexpr int max_measures = 12;

  /// Effect of one measure on the body at `centre`: translation [1 or m/rad] and small rotation per unit.
  struct LinearMeasure
  {
    Vector3d translation, rotation;
  };

  /// A vector fixed to the body, and its derivatives:  x' = J u',  x'' = J u'' + bias.
  struct MovedVector
  {
    Vector3d                                                     value, rate, bias;
    Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, max_measures> J;
  };

  /// On the ground: no measures.
  explicit Placement(const Vector3d &point = Vector3d::Zero());
  /// A body whose reference point is `centre`.
  Placement(const Vector3d &point, const Vector3d &centre, std::vector<LinearMeasure> linear);
  /// The same, with a rotation about the unit vector n.
  Placement(const Vector3d &point, const Vector3d &centre, std::vector<LinearMeasure> linear, const Vector3d &n);

  /// A free spatial body: the displacement of its centre of mass and of its three directors.
  static Placement free(const Vector3d &point, const Vector3d &centre);

  int             n_measures() const { return free_ ? max_measures : int(linear_.size()) + (turns_ ? 1 : 0); }
  bool            turns() const { return turns_; }
  const Vector3d &point() const { return point_; }                                    ///< at u = 0 [m]
  double          size() const { return centre_.norm() + (point_ - centre_).norm(); } ///< of the terms of x [m]

  /// Whether measure i can be omitted: not the angle, nor those of a spatial body.
  bool is_linear(int i) const { return i < int(linear_.size()); }
  /// The same point of a body without the linear measure i.
  Placement without(int i) const;

  /// Effect of measure i on the reference point and the directions of the body, per unit at u = 0.
  Vector3d translation(int i) const;
  Vector3d rotation(int i) const;

  /// @param v  null: rate and bias are not computed
  void position(const double *u, const double *v, MovedVector &x) const;
  /// @param e  direction at u = 0
  void     direction(const Vector3d &e, const double *u, const double *v, MovedVector &moved) const;
  Vector3d position(const double *u) const;
  Vector3d direction(const Vector3d &e, const double *u) const;

private:
  void find_rotations();
  void move(const Vector3d &arm, const double *u, const double *v, MovedVector &x) const;
  void move_freely(const Vector3d &arm, const double *u, const double *v, MovedVector &x) const;

  Vector3d                   point_, centre_;
  std::vector<LinearMeasure> linear_;
  bool                       turns_ = false, free_ = false;
  bool                       rotates_ = false; ///< some linear measure has a rotation
  Vector3d                   n_       = Vector3d::Zero();
};

} // namespace gestell::mechanism
