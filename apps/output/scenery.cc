#include "apps/output/scenery.h"

namespace gestell::apps
{

double value(const coupling::Measure &measure, const Eigen::VectorXd &q)
{
  double u = 0.;
  for (const auto &[coordinate, weight] : measure)
    u += weight * q(coordinate);
  return u;
}

Eigen::Vector3d translation(const coupling::Marker &marker, const Eigen::VectorXd &q)
{
  return {value(marker.translation[0], q), value(marker.translation[1], q), value(marker.translation[2], q)};
}

} // namespace gestell::apps
