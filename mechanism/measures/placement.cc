#include "mechanism/measures/placement.h"

#include <cmath>
#include <utility>

namespace gestell::mechanism
{

Placement::Placement(const Vector3d &point) : point_(point), centre_(point) {}

Placement::Placement(const Vector3d &point, const Vector3d &centre, std::vector<LinearMeasure> linear)
    : point_(point), centre_(centre), linear_(std::move(linear))
{
  find_rotations();
}

Placement::Placement(const Vector3d &point, const Vector3d &centre, std::vector<LinearMeasure> linear,
                     const Vector3d &n)
    : point_(point), centre_(centre), linear_(std::move(linear)), turns_(true), n_(n)
{
  find_rotations();
}

void Placement::find_rotations()
{
  rotates_ = false;
  for (const LinearMeasure &measure : linear_)
    rotates_ = rotates_ || !measure.rotation.isZero(0.);
}

Placement Placement::free(const Vector3d &point, const Vector3d &centre)
{
  Placement placement(point, centre, {});
  placement.free_ = true;
  return placement;
}

Placement Placement::without(int i) const
{
  Placement rest = *this;
  rest.linear_.erase(rest.linear_.begin() + i);
  rest.find_rotations();
  return rest;
}

Vector3d Placement::translation(int i) const
{
  if (free_)
    return i < 3 ? Vector3d(Vector3d::Unit(i)) : Vector3d(Vector3d::Zero());
  return i < int(linear_.size()) ? linear_[i].translation : Vector3d::Zero();
}

/// Rotation of rigid directors: u_i = theta x e_i gives theta = 1/2 sum e_i x u_i.
Vector3d Placement::rotation(int i) const
{
  if (free_)
    return i < 3 ? Vector3d(Vector3d::Zero()) : Vector3d(0.5 * Vector3d::Unit(i / 3 - 1).cross(Vector3d::Unit(i % 3)));
  return i < int(linear_.size()) ? linear_[i].rotation : n_;
}

/// sum arm_i d_i is linear in u, so that the bias is zero.
void Placement::move_freely(const Vector3d &arm, const double *u, const double *v, MovedVector &x) const
{
  using Directors = Eigen::Map<const Eigen::Matrix3d>;
  x.value         = arm + Directors(u + 3) * arm;
  if (v)
  {
    x.rate = Directors(v + 3) * arm;
    x.bias.setZero();
  }
  x.J.setZero(3, max_measures);
  for (int i = 0; i < 3; ++i)
    for (int d = 0; d < 3; ++d)
      x.J(d, 3 + 3 * i + d) = arm[i];
}

/// The turned arm (1 + theta x) rho(phi) with its derivatives.
void Placement::move(const Vector3d &arm, const double *u, const double *v, MovedVector &x) const
{
  if (free_)
  {
    move_freely(arm, u, v, x);
    return;
  }
  const int n_linear = int(linear_.size());
  x.J.resize(3, n_measures());
  Vector3d rho = arm, first = Vector3d::Zero();
  if (turns_)
  {
    const double   c = std::cos(u[n_linear]), s = std::sin(u[n_linear]);
    const Vector3d along = n_.dot(arm) * n_, across = arm - along;
    rho               = along + c * across + s * n_.cross(arm);
    first             = n_.cross(rho);
    x.J.col(n_linear) = first;
  }
  x.value        = rho;
  Vector3d theta = Vector3d::Zero();
  if (rotates_)
  {
    for (int i = 0; i < n_linear; ++i)
    {
      theta += u[i] * linear_[i].rotation;
      x.J.col(i) = linear_[i].rotation.cross(rho);
    }
    x.value += theta.cross(rho);
    if (turns_)
      x.J.col(n_linear) += theta.cross(first);
  }
  else
    x.J.leftCols(n_linear).setZero();
  if (!v && n_measures() > 0)
    return;

  x.rate.setZero();
  x.bias.setZero();
  Vector3d theta_rate = Vector3d::Zero();
  for (int i = 0; i < n_linear; ++i)
    theta_rate += v[i] * linear_[i].rotation;
  if (turns_)
  {
    const double   w      = v[n_linear];
    const Vector3d second = n_.cross(first);
    x.rate                = w * x.J.col(n_linear);
    x.bias                = w * w * (second + theta.cross(second)) + 2. * w * theta_rate.cross(first);
  }
  x.rate += theta_rate.cross(rho);
}

namespace
{

/// Position if the carrier does not tilt: the arm turns about n only,  rho = along + c across + s beyond.
void turn(const Vector3d &n, const Vector3d &centre, const Vector3d &arm,
          const std::vector<Placement::LinearMeasure> &linear, const double *u, const double *v,
          Placement::MovedVector &x)
{
  const int      n_linear = int(linear.size());
  const double   c = std::cos(u[n_linear]), s = std::sin(u[n_linear]);
  const Vector3d along = n.dot(arm) * n, across = arm - along, beyond = n.cross(arm);
  const Vector3d turned = c * across + s * beyond, first = c * beyond - s * across;
  x.J.resize(3, n_linear + 1);
  x.J.col(n_linear) = first;
  x.value           = along + turned + centre;
  for (int i = 0; i < n_linear; ++i)
  {
    x.value += u[i] * linear[i].translation;
    x.J.col(i) = linear[i].translation;
  }
  if (!v)
    return;
  const double w = v[n_linear];
  x.rate         = w * first;
  x.bias         = -w * w * turned;
  for (int i = 0; i < n_linear; ++i)
    x.rate += v[i] * linear[i].translation;
}

} // namespace

void Placement::position(const double *u, const double *v, MovedVector &x) const
{
  if (turns_ && !rotates_)
  {
    turn(n_, centre_, point_ - centre_, linear_, u, v, x);
    return;
  }
  move(point_ - centre_, u, v, x);
  x.value += centre_;
  for (int d = 0; free_ && d < 3; ++d)
  {
    x.value[d] += u[d];
    x.J(d, d) = 1.;
  }
  for (std::size_t i = 0; i < linear_.size(); ++i)
  {
    x.value += u[i] * linear_[i].translation;
    x.J.col(Eigen::Index(i)) += linear_[i].translation;
  }
  if (!v)
    return;
  for (int d = 0; free_ && d < 3; ++d)
    x.rate[d] += v[d];
  for (std::size_t i = 0; i < linear_.size(); ++i)
    x.rate += v[i] * linear_[i].translation;
}

void Placement::direction(const Vector3d &e, const double *u, const double *v, MovedVector &moved) const
{
  move(e, u, v, moved);
}

namespace
{
constexpr double no_rates[Placement::max_measures] = {};
}

Vector3d Placement::position(const double *u) const
{
  MovedVector x;
  position(u, no_rates, x);
  return x.value;
}

Vector3d Placement::direction(const Vector3d &e, const double *u) const
{
  MovedVector moved;
  move(e, u, no_rates, moved);
  return moved.value;
}

} // namespace gestell::mechanism
