#include "mechanism/placement.h"

#include <cmath>
#include <utility>

namespace gestell::mechanism
{

Placement::Placement(const Vector3d &point) : point_(point), centre_(point) {}

Placement::Placement(const Vector3d &point, const Vector3d &centre, std::vector<LinearMeasure> linear)
    : point_(point), centre_(centre), linear_(std::move(linear))
{
}

Placement::Placement(const Vector3d &point, const Vector3d &centre, std::vector<LinearMeasure> linear,
                     const Vector3d &n)
    : point_(point), centre_(centre), linear_(std::move(linear)), turns_(true), n_(n)
{
}

/// The turned arm (1 + theta x) rho(phi) with its derivatives.
void Placement::move(const Vector3d &arm, const double *u, const double *v, MovedVector &x) const
{
  const int n_linear = int(linear_.size());
  x.J.resize(3, n_measures());
  Vector3d theta = Vector3d::Zero(), theta_rate = Vector3d::Zero();
  for (int i = 0; i < n_linear; ++i)
  {
    theta += u[i] * linear_[i].rotation;
    theta_rate += v[i] * linear_[i].rotation;
  }
  Vector3d rho = arm;
  x.rate.setZero();
  x.bias.setZero();
  if (turns_)
  {
    const double   c = std::cos(u[n_linear]), s = std::sin(u[n_linear]), w = v[n_linear];
    const Vector3d along = n_.dot(arm) * n_, across = arm - along;
    rho                   = along + c * across + s * n_.cross(arm);
    const Vector3d first  = n_.cross(rho);
    const Vector3d second = n_.cross(first);
    x.J.col(n_linear)     = first + theta.cross(first);
    x.rate                = w * x.J.col(n_linear);
    x.bias                = w * w * (second + theta.cross(second)) + 2. * w * theta_rate.cross(first);
  }
  for (int i = 0; i < n_linear; ++i)
    x.J.col(i) = linear_[i].rotation.cross(rho);
  x.rate += theta_rate.cross(rho);
  x.value = rho + theta.cross(rho);
}

void Placement::position(const double *u, const double *v, MovedVector &x) const
{
  move(point_ - centre_, u, v, x);
  x.value += centre_;
  for (std::size_t i = 0; i < linear_.size(); ++i)
  {
    x.value += u[i] * linear_[i].translation;
    x.rate += v[i] * linear_[i].translation;
    x.J.col(Eigen::Index(i)) += linear_[i].translation;
  }
}

void Placement::direction(const Vector3d &e, const double *u, const double *v, MovedVector &moved) const
{
  move(e, u, v, moved);
}

namespace
{
constexpr double at_rest[Placement::max_measures] = {};
}

Vector3d Placement::position(const double *u) const
{
  MovedVector x;
  position(u, at_rest, x);
  return x.value;
}

Vector3d Placement::direction(const Vector3d &e, const double *u) const
{
  MovedVector moved;
  move(e, u, at_rest, moved);
  return moved.value;
}

} // namespace gestell::mechanism
