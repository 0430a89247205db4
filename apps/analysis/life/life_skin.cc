#include "apps/analysis/life/life_skin.h"

#include <Eigen/Geometry>

namespace gestell::apps
{

Eigen::Vector3d LifeSkin::normal(const std::array<int, 3> &triangle) const
{
  const Eigen::Vector3d &a = position[std::size_t(triangle[0])];
  return (position[std::size_t(triangle[1])] - a).cross(position[std::size_t(triangle[2])] - a);
}

LifeSkin skin_of(const coupling::ReducedFrame &frame)
{
  LifeSkin            skin;
  Eigen::AlignedBox3d box;
  for (const int point : frame.stress.point)
  {
    const auto &x = frame.points[std::size_t(point)];
    box.extend(skin.position.emplace_back(x[0], x[1], x[2]));
  }
  skin.size      = skin.position.empty() ? 0. : box.diagonal().norm();
  skin.triangles = frame.stress.triangles;
  std::vector<double> area(skin.position.size(), 0.);
  skin.directions.resize(skin.position.size());
  for (const auto &triangle : skin.triangles)
    for (const int i : triangle)
    {
      skin.directions[std::size_t(i)].normal += skin.normal(triangle);
      area[std::size_t(i)] += skin.normal(triangle).norm();
    }
  constexpr double flat = 0.94; // |sum of n A| / sum of A: faces at some 40 degrees, a stress in neither of them
  for (std::size_t i = 0; i < area.size(); ++i)
  {
    Eigen::Vector3d &normal = skin.directions[i].normal;
    const double     length = normal.norm();
    normal                  = length > flat * area[i] ? Eigen::Vector3d(normal / length) : Eigen::Vector3d::Zero();
  }
  return skin;
}

std::vector<char> points_by_rigid(const coupling::ReducedStress &stress, bool beside)
{
  std::vector<char> chosen;
  for (const int nearby : stress.nearby)
    chosen.push_back((nearby >= 0) == beside);
  return chosen;
}

} // namespace gestell::apps
