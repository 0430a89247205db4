// Alone in this file, so that all else of the output can be linked and tested without a machine.
#include "apps/output/values/scenery.h"

namespace gestell::apps
{

Scenery scenery_of(const coupling::Machine &machine)
{
  Scenery scenery;
  scenery.n_frame = machine.n_frame();
  scenery.bodies  = machine.bodies();
  scenery.rods    = machine.rods();
  scenery.bars    = machine.bars();
  scenery.pins    = machine.pins();

  const auto take_interfaces = [&](const std::vector<fem::Interface> &interfaces)
  {
    for (const fem::Interface &interface : interfaces)
    {
      scenery.interfaces.push_back(machine.marker("frame." + interface.name));
      scenery.interface_positions.emplace_back(interface.name, interface.position);
    }
  };
  if (const coupling::ReducedFrame *frame = machine.reduced_frame())
  {
    scenery.points       = frame->points;
    scenery.triangles    = frame->triangles;
    scenery.displacement = [frame](const Eigen::VectorXd &p) -> Eigen::VectorXd
    { return (frame->displacement * p.cast<float>()).cast<double>(); };
    take_interfaces(frame->interfaces);
  }
  else if (const fem::FrameMatrices *frame = machine.full_frame())
  {
    scenery.points       = frame->picture.points;
    scenery.triangles    = frame->picture.triangles;
    scenery.displacement = [frame](const Eigen::VectorXd &q) -> Eigen::VectorXd
    { return frame->picture.displacement * q; };
    take_interfaces(frame->interfaces);
  }
  return scenery;
}

} // namespace gestell::apps
