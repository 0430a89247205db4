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

Scenery for_pictures(const Scenery &scenery, std::size_t triangles)
{
  if (scenery.triangles.size() <= triangles)
    return scenery;
  const Skin skin   = skin_of(scenery, Eigen::VectorXd::Zero(scenery.n_frame));
  double     edge   = skin.size() / 100.;
  CoarseMesh coarse = coarse_mesh(skin, edge);
  while (coarse.triangles.size() > triangles)
    coarse = coarse_mesh(skin, edge *= 1.4);

  Scenery light   = scenery;
  light.triangles = coarse.triangles;
  light.points.clear();
  for (const int i : coarse.points)
    light.points.push_back(scenery.points[i]);
  light.displacement = [all = scenery.displacement, chosen = coarse.points](const Eigen::VectorXd &p) -> Eigen::VectorXd
  {
    const Eigen::VectorXd u = all(p);
    Eigen::VectorXd       few(3 * static_cast<long>(chosen.size()));
    for (std::size_t i = 0; i < chosen.size(); ++i)
      few.segment<3>(3 * static_cast<long>(i)) = u.segment<3>(3 * chosen[i]);
    return few;
  };
  return light;
}

} // namespace gestell::apps
