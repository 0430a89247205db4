#include "apps/scene/read/read_tensor.h"

#include <Eigen/Geometry>

#include <cmath>

namespace gestell::apps
{

Eigen::Matrix3d read_axes(const SceneTable &table, const std::string &key)
{
  const auto      rows = table.matrix(key, kind::number);
  Eigen::Matrix3d axes;
  if (rows.size() != 2 || rows[0].size() != 3)
    throw table.error(
        key, "needs two directions [[x, y, z], [x, y, z]] of the first two values; the third is perpendicular to both");
  for (int i = 0; i < 2; ++i)
    axes.col(i) = Eigen::Vector3d(rows[i].data());
  const double a = axes.col(0).norm(), b = axes.col(1).norm();
  if (!(a > 0.) || !(b > 0.) || std::abs(axes.col(0).dot(axes.col(1))) > 1e-9 * a * b)
    throw table.error(key, "needs two perpendicular directions");
  axes.col(0) /= a;
  axes.col(1) /= b;
  axes.col(2) = axes.col(0).cross(axes.col(1));
  return axes;
}

Key principal_axes_key()
{
  return key::composed("principal_axes", Key::Form::matrix, kind::number, {},
                       "directions of the first two of three moments, `[[x, y, z], [x, y, z]]`")
      .by_default("global axes");
}

Key per_direction_key(const std::string &name, const Kind &kind, const std::string &meaning)
{
  return key::number(name, kind, meaning).from_zero().also({Key::Form::vector}).by_default(0.);
}

Vector3 read_per_direction(const SceneTable &table, const std::string &key, const Kind &kind)
{
  Vector3 value{};
  if (table.is_array(key))
    value = table.vector(key, kind);
  else if (table.has(key))
    value.fill(table.number(key, kind));
  for (const double x : value)
    if (x < 0.)
      throw table.error(key, "needs " + with_article(kind) + " of zero or more in every direction");
  return value;
}

Eigen::Matrix3d read_tensor(const SceneTable &table)
{
  const std::string needed = "needs three moments [Jx, Jy, Jz], or the tensor as three rows [[Jxx, Jxy, Jxz], ..]";
  if (table.has("inertia") && !table.is_array("inertia"))
    throw table.error("inertia", needed + " of the body about its centre of mass");
  Eigen::Matrix3d J = Eigen::Matrix3d::Zero();
  if (table.is_matrix("inertia"))
  {
    const auto rows = table.matrix("inertia", kind::inertia);
    if (rows.size() != 3 || rows[0].size() != 3)
      throw table.error("inertia", needed);
    if (table.has("principal_axes"))
      throw table.error("principal_axes", "needs three moments; a tensor contains its axes");
    for (int i = 0; i < 3; ++i)
      J.row(i) = Eigen::RowVector3d(rows[i].data());
    return J;
  }
  const Vector3 moments = table.vector("inertia");
  J.diagonal()          = Eigen::Vector3d(moments.data());
  if (!table.has("principal_axes"))
    return J;
  const Eigen::Matrix3d axes = read_axes(table, "principal_axes");
  return axes * J * axes.transpose();
}

} // namespace gestell::apps
