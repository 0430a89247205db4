// In a file of its own, so that the rest of the output can be linked and tested without a machine.
#include "apps/output/values/scenery.h"

namespace gestell::apps
{

Scenery scenery_of(const coupling::Machine &machine)
{
  Scenery scenery;
  scenery.n_frame = machine.model().n_frame();
  scenery.bodies  = machine.model().bodies();
  scenery.rods    = machine.model().rods();
  scenery.bars    = machine.model().bars();
  scenery.pins    = machine.model().pins();

  const auto take_interfaces = [&](const std::vector<fem::Interface> &interfaces)
  {
    for (const fem::Interface &interface : interfaces)
    {
      scenery.interfaces.push_back(machine.model().marker("frame." + interface.name));
      scenery.interface_positions.emplace_back(interface.name, interface.position);
    }
  };
  if (const coupling::ReducedFrame *frame = machine.model().reduced_frame())
  {
    scenery.points       = frame->points;
    scenery.triangles    = frame->triangles;
    scenery.displacement = [frame](const Eigen::VectorXd &p) -> Eigen::VectorXd
    { return (frame->displacement * p.cast<float>()).cast<double>(); };
    take_interfaces(frame->interfaces);
  }
  else if (const fem::FrameMatrices *frame = machine.model().full_frame())
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
