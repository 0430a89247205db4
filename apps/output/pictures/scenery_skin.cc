#include "apps/output/pictures/scenery_skin.h"

namespace gestell::apps
{

Skin skin_of(const Scenery &scenery, const Eigen::VectorXd &p)
{
  Skin skin;
  for (const auto &x : scenery.points)
    skin.points.emplace_back(x[0], x[1], x[2]);
  skin.displacement.assign(skin.points.size(), Eigen::Vector3d::Zero());
  skin.triangles = scenery.triangles;
  if (skin.points.empty())
    return skin;
  const Eigen::VectorXd u = scenery.displacement(p.head(scenery.n_frame));
  for (std::size_t i = 0; i < skin.points.size(); ++i)
    skin.displacement[i] = u.segment<3>(3 * static_cast<long>(i));
  return skin;
}

} // namespace gestell::apps
