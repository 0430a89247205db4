#include "fem/recovery/stress_points.h"

#include "fem/values/message_text.h"
#include "fem/values/number_text.h"
#include "fem/values/triangle_surface.h"

#include <Eigen/LU>

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace gestell::fem
{

namespace
{

using Eigen::Vector3d;

/// A point of the skin between three stress points.
struct SkinPoint
{
  Vector3d           x;
  std::array<int, 3> corners{};                                                ///< stress points
  Vector3d           weights;                                                  ///< of their values
  double             distance = std::numeric_limits<double>::max(), side = 0.; ///< from the given point; longest [m]
};

SkinPoint nearest_on_skin(const Vector3d &at, const StressRecovery &recovery, const Picture &picture)
{
  SkinPoint best;
  for (const auto &triangle : recovery.triangles)
  {
    std::array<Vector3d, 3> corners;
    for (int k = 0; k < 3; ++k)
      corners[k] = Vector3d(picture.points[recovery.point[triangle[k]]].data());
    const Vector3d x        = nearest_on_triangle(at, corners);
    const double   distance = (x - at).norm();
    if (!(distance < best.distance))
      continue;
    const Vector3d              ab = corners[1] - corners[0], ac = corners[2] - corners[0];
    Eigen::Matrix<double, 3, 2> sides;
    sides << ab, ac;
    const Eigen::Vector2d s = (sides.transpose() * sides).inverse() * (sides.transpose() * (x - corners[0]));
    best                    = {x, triangle, Vector3d(1. - s.sum(), s[0], s[1]), distance,
                               std::max({ab.norm(), ac.norm(), (ac - ab).norm()})};
  }
  return best;
}

/// Rows of the six components on q [n x 6].
Eigen::MatrixXd stress_rows(const StressRecovery &recovery, const SkinPoint &point)
{
  constexpr int   axis[stress_components][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}};
  Eigen::MatrixXd on_u                       = Eigen::MatrixXd::Zero(recovery.u.rows(), stress_components);
  for (int k = 0; k < 3; ++k)
  {
    const auto &[lambda, mu] = recovery.lame[point.corners[k]];
    for (StressRecovery::Rows::InnerIterator entry(recovery.mean, point.corners[k]); entry; ++entry)
      for (int c = 0; c < stress_components; ++c)
      {
        const auto   node = entry.col() / 3, l = entry.col() % 3; // a share of H_kl times u_k of the node
        const double share = point.weights[k] * entry.value();
        const auto &[a, b] = axis[c];
        if (a == b)
          on_u(3 * node + l, c) += lambda * share;
        if (l == b)
          on_u(3 * node + a, c) += mu * share;
        if (l == a)
          on_u(3 * node + b, c) += mu * share;
      }
  }
  return recovery.u.transpose() * on_u;
}

void require_near(const StressPointSpecification &point, const SkinPoint &found)
{
  if (found.distance <= found.side)
    return;
  throw std::invalid_argument(point.place + ": the point " + text(point.at) + " m is " + rounded(found.distance) +
                              " m away from the surface of the frame, whose nearest point is " +
                              text(Vector3{found.x[0], found.x[1], found.x[2]}) +
                              " m; an element there has sides of up to " + rounded(found.side) +
                              " m. Give a point on the surface.");
}

void report(const StressPointSpecification &point, const SkinPoint &found, const StressRecovery &recovery,
            FrameMatrices &frame)
{
  const std::string head = "stress point " + point.name + ": ";
  frame.statements.push_back(head + rounded(1e3 * found.distance, 3) + " mm from the given point, at " +
                             text(Vector3{found.x[0], found.x[1], found.x[2]}) + " m");
  for (int k = 0; k < 3; ++k)
    if (const int rigid = recovery.nearby[found.corners[k]]; rigid >= 0)
    {
      frame.notes.push_back(head + "in an element at the rigid " + recovery.rigid[rigid] +
                            ", at whose edge the stress has no limit as the mesh becomes finer");
      return;
    }
}

} // namespace

void add_stress_points(const std::vector<StressPointSpecification> &points, const StressRecovery &recovery,
                       FrameMatrices &frame)
{
  for (const StressPointSpecification &point : points)
  {
    const SkinPoint found = nearest_on_skin(Vector3d(point.at.data()), recovery, frame.picture);
    require_near(point, found);
    report(point, found, recovery, frame);
    const Eigen::MatrixXd rows = stress_rows(recovery, found);
    const auto            add  = [&](const char *component, const Eigen::VectorXd &row) {
      frame.outputs.push_back({"stress." + point.name + "." + component, "Pa", row, Eigen::VectorXd::Zero(row.size())});
    };
    for (int c = 0; c < stress_components; ++c)
      add(stress_names[c], rows.col(c));
    if (!point.along)
      continue;
    const Vector3d n = Vector3d(point.along->data()).normalized();
    if (!n.allFinite() || !(n.norm() > 0.))
      throw std::invalid_argument(point.place + ": the direction is zero; give three numbers such as [0, 0, 1].");
    Eigen::Matrix<double, stress_components, 1> weights;
    weights << n.cwiseAbs2(), 2. * n[0] * n[1], 2. * n[1] * n[2], 2. * n[0] * n[2];
    add("normal", rows * weights);
  }
}

} // namespace gestell::fem
