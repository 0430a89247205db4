#include "fem/values/face_fields.h"

#include <Eigen/Geometry>

namespace gestell::fem
{

namespace
{

using Eigen::Index;
using Eigen::Matrix3Xd;
using Eigen::Vector3d;

/// P_0 ... P_p, by (k + 1) P_{k+1} = (2 k + 1) x P_k - k P_{k-1}.
Eigen::VectorXd legendre(int p, double x)
{
  Eigen::VectorXd P(p + 1);
  P[0] = 1.;
  if (p > 0)
    P[1] = x;
  for (int k = 1; k < p; ++k)
    P[k + 1] = ((2 * k + 1) * x * P[k] - k * P[k - 1]) / (k + 1);
  return P;
}

/// Half sides of the rectangle around points, and their middle, along two axes.
struct Extent
{
  Eigen::Vector2d low, high;

  Extent(const Matrix3Xd &points, const Eigen::Matrix3d &axes)
  {
    const Eigen::Matrix2Xd in_plane = axes.leftCols<2>().transpose() * points;
    low                             = in_plane.rowwise().minCoeff();
    high                            = in_plane.rowwise().maxCoeff();
  }
};

/// The same axes for the same plane, whatever its mesh: along the projection of the global axis most across the normal.
Eigen::Matrix3d axes_of(const Vector3d &normal)
{
  Index least = 0;
  normal.cwiseAbs().minCoeff(&least);
  Eigen::Matrix3d axes;
  axes.col(0) = (Vector3d::Unit(least) - normal[least] * normal).normalized();
  axes.col(1) = normal.cross(Vector3d(axes.col(0)));
  axes.col(2) = normal;
  return axes;
}

/// Corners of the rectangle.
Matrix3Xd corners_of(const PlaneFace &face)
{
  Matrix3Xd corners(3, 4);
  for (int i = 0; i < 4; ++i)
    corners.col(i) = face.centre + (i & 1 ? 1. : -1.) * face.half[0] * face.axes.col(0) +
                     (i & 2 ? 1. : -1.) * face.half[1] * face.axes.col(1);
  return corners;
}

/// Whether neither side of one rectangle parts it from the other.
bool unparted(const PlaneFace &a, const PlaneFace &b)
{
  const Extent          other(corners_of(b).colwise() - a.centre, a.axes);
  const Eigen::Vector2d least = 1e-6 * a.half;
  return (other.low.array() < (a.half - least).array()).all() && (other.high.array() > (least - a.half).array()).all();
}

} // namespace

bool PlaneFace::overlaps(const PlaneFace &other) const
{
  return known() && other.known() && unparted(*this, other) && unparted(other, *this);
}

int n_fields(int degree)
{
  return degree > 0 ? 3 * (degree + 1) * (degree + 2) / 2 - 6 : 0;
}

Eigen::RowVectorXd polynomials_at(const PlaneFace &face, const Vector3d &x)
{
  const Eigen::Vector2d r = face.axes.leftCols<2>().transpose() * (x - face.centre);
  const Eigen::VectorXd P = legendre(face.degree, r[0] / face.half[0]), Q = legendre(face.degree, r[1] / face.half[1]);
  Eigen::RowVectorXd    products((face.degree + 1) * (face.degree + 2) / 2);
  Index                 k = 0;
  for (int degree = 0; degree <= face.degree; ++degree)
    for (int j = 0; j <= degree; ++j)
      products[k++] = P[degree - j] * Q[j];
  return products;
}

Matrix3Xd fields_at(const PlaneFace &face, const Vector3d &x)
{
  Matrix3Xd phi(3, n_fields(face.degree));
  if (face.degree == 0)
    return phi;
  const Eigen::RowVectorXd products = polynomials_at(face, x);
  const auto               e_1 = face.axes.col(0), e_2 = face.axes.col(1);
  phi.col(0) = e_1 * products[1];
  phi.col(1) = e_2 * products[2];
  phi.col(2) = (e_1 * products[2] * face.half[1] + e_2 * products[1] * face.half[0]) / face.half.maxCoeff();
  for (Index k = 3; k < products.size(); ++k)
    phi.middleCols<3>(3 * k - 6) = face.axes * products[k];
  return phi;
}

PlaneFace plane_face(const Matrix3Xd &points, const Vector3d &normal)
{
  PlaneFace face;
  if (normal.isZero(0.) || points.cols() == 0)
    return face;
  const Eigen::Matrix3d    axes = axes_of(normal);
  const Extent             extent(points, axes);
  const Eigen::RowVectorXd height    = normal.transpose() * points;
  constexpr double         off_plane = 1e-6; // of the reach of the points: digits of files and of CAD programs
  if (height.maxCoeff() - height.minCoeff() > off_plane * (extent.high - extent.low).norm())
    return face;
  face.axes   = axes;
  face.half   = 0.5 * (extent.high - extent.low);
  face.centre = axes.leftCols<2>() * (0.5 * (extent.high + extent.low)) + height.mean() * normal;
  return face;
}

} // namespace gestell::fem
