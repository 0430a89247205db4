#include "mechanism/joints/orthonormal_directors.h"

#include <Eigen/Geometry>

namespace gestell::mechanism
{

namespace
{
using Eigen::Matrix3d, Eigen::Vector3d;
using Map = Eigen::Map<const Matrix3d>;

/// The two directors of equation r, and the factor of their product.
struct Product
{
  int    i, j;
  double factor;
};
constexpr Product products[] = {{0, 0, 0.5}, {1, 1, 0.5}, {2, 2, 0.5}, {1, 2, 1.}, {2, 0, 1.}, {0, 1, 1.}};

Matrix3d directors(const double *u)
{
  return Matrix3d::Identity() + Map(u);
}
} // namespace

/// Computed from u alone, so that the rounding of 1 does not affect small rotations.
void OrthonormalDirectors::constraint(const LocalMotion &motion, const double *, double *g, double *G) const
{
  const Map                               u(motion.u);
  const Matrix3d                          D = directors(motion.u);
  Eigen::Map<Eigen::Matrix<double, 6, 9>> gradient(G);
  gradient.setZero();
  for (int r = 0; r < 6; ++r)
  {
    const auto [i, j, factor] = products[r];
    g[r]                      = factor * (u(i, j) + u(j, i) + u.col(i).dot(u.col(j)));
    gradient.block<1, 3>(r, 3 * i) += factor * D.col(j).transpose();
    gradient.block<1, 3>(r, 3 * j) += factor * D.col(i).transpose();
  }
}

void OrthonormalDirectors::constraint_rates(const LocalMotion &motion, const double *, double *rate, double *bias) const
{
  const Map v(motion.v);
  for (int r = 0; r < 6; ++r)
  {
    const auto [i, j, factor] = products[r];
    rate[r]                   = 0.;
    bias[r]                   = 2. * factor * v.col(i).dot(v.col(j));
  }
}

bool OrthonormalDirectors::depends(int equation, int measure) const
{
  return measure / 3 == products[equation].i || measure / 3 == products[equation].j;
}

void OrthonormalDirectors::geometric(const LocalMotion &motion, const double *, double *K) const
{
  Eigen::Map<Eigen::Matrix<double, 9, 9>> stiffness(K);
  for (int r = 0; motion.lambda && r < 6; ++r)
  {
    const auto [i, j, factor] = products[r];
    stiffness.block<3, 3>(3 * i, 3 * j) -= factor * motion.lambda[r] * Matrix3d::Identity();
    stiffness.block<3, 3>(3 * j, 3 * i) -= factor * motion.lambda[r] * Matrix3d::Identity();
  }
}

std::string OrthonormalDirectors::constraint_name(int i) const
{
  static const char *const names[] = {"length 1", "length 2", "length 3", "angle 23", "angle 31", "angle 12"};
  return names[i];
}

Vector3d OrthonormalDirectors::angular_velocity(const double *u, const double *v)
{
  const Matrix3d D     = directors(u);
  Vector3d       twice = Vector3d::Zero();
  for (int i = 0; i < 3; ++i)
    twice += D.col(i).cross(Map(v).col(i));
  return 0.5 * twice;
}

Matrix3d OrthonormalDirectors::measures(const Vector3d &rotation)
{
  const double angle = rotation.norm();
  if (!(angle > 0.))
    return Matrix3d::Zero();
  return Eigen::AngleAxisd(angle, rotation / angle).toRotationMatrix() - Matrix3d::Identity();
}

std::vector<Quantity> OrthonormalDirectors::quantities() const
{
  return {{"wx", "rad/s"}, {"wy", "rad/s"}, {"wz", "rad/s"}, {"rx", "rad"}, {"ry", "rad"}, {"rz", "rad"}};
}

double OrthonormalDirectors::quantity(int i, const LocalMotion &motion, const double *) const
{
  if (i < 3)
    return angular_velocity(motion.u, motion.v)[i];
  const Eigen::AngleAxisd turned{Eigen::Quaterniond(directors(motion.u))};
  return turned.angle() * turned.axis()[i - 3];
}

} // namespace gestell::mechanism
