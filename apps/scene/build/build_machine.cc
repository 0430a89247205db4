#include "apps/scene/build/build_machine.h"

#include "apps/scene/build/build_joints.h"
#include "apps/scene/build/build_measures.h"
#include "apps/scene/build/build_unbalance.h"
#include "apps/scene/build/carried_bodies.h"
#include "coupling/reduction/dense_frame.h"

#include <regex>

namespace gestell::apps
{
namespace
{

constexpr Eigen::Index largest_dense_frame = 500; // coordinates; above, sparse solves win

/// Heads what the machine says against a name with the place in the scene.
template <typename Make>
auto placed(const std::string &place, Make make)
{
  try
  {
    return make();
  }
  catch (const std::invalid_argument &e)
  {
    throw std::invalid_argument(place + ": " + e.what());
  }
}

void add_body(coupling::MachineModel &machine, const BodyRequest &body)
{
  check_carrier(machine, body);
  switch (body.kind)
  {
  case coupling::BodyKind::rotor:
    machine.add_rotor(body.name, body.axis, body.inertia, body.mass, body.carrier);
    break;
  case coupling::BodyKind::slider:
    machine.add_slider(body.name, body.axis, body.mass, body.carrier);
    break;
  case coupling::BodyKind::point:
    machine.add_point(body.name, body.mass, body.position);
    break;
  case coupling::BodyKind::planar:
    machine.add_planar(body.name, body.axis, body.mass, body.inertia, body.position);
    break;
  case coupling::BodyKind::rigid:
    machine.add_rigid(body.name, body.mass, body.tensor, body.position);
    break;
  }
  machine.draw(body.name, body.position, body.radius, body.size);
}

void fill(coupling::MachineModel &machine, const Scene &scene)
{
  for (const auto &body : scene.bodies)
    placed(body.place, [&] { add_body(machine, body); });
  const auto place = [&](const std::string &element) { return scene.element_places.at(element); };
  for (const auto &point : scene.point_masses)
    placed(place(point.name),
           [&] { machine.add_point_mass(point.name, point.marker, point.mass, point.inertia, point.offset); });
  for (const auto &spring : scene.linear)
    placed(place(spring.name),
           [&]
           {
             machine.add_linear(spring.name, measures_of({spring.u}, machine).front(),
                                {spring.stiffness, spring.damping, spring.preload, spring.rest}, spring.force_unit);
           });
  for (const auto &load : scene.loads)
    placed(place(load.name),
           [&]
           {
             machine.add_load(load.name, measures_of({load.u}, machine).front(), load.constant, load.oscillations,
                              load.force_unit);
           });
  for (const auto &point : scene.places)
    if (point.point.marker != "ground")
      placed(point.place, [&] { machine.add_place(point.name, apps::placed(machine, point.point)); });
  add_measures(machine, scene);
  for (const auto &joint : scene.joints)
    placed(joint.place, [&] { add_joint(machine, joint); });
  for (const auto &element : scene.elements)
    placed(place(element.name),
           [&]
           {
             if (!element.on.empty() || element.own)
             {
               attach_on_measure(machine, element);
               return;
             }
             if (element.pair)
             {
               attach_between(machine, element);
               return;
             }
             auto measures = measures_of(element.measures, machine);
             for (const auto &lag : element.lags)
               measures.push_back({{machine.add_lag(lag.name, lag.time_constant), 1.}});
             machine.attach(element.name, element.element, measures, element.kind);
           });
  for (const auto &body : scene.bodies)
    if (body.unbalance)
      placed(body.place, [&] { attach_unbalance(machine, body, scene.gravity); });
  for (const auto &own : scene.switches)
    placed(own.place, [&] { add_switch(machine, own); });
  for (const auto &rod : scene.rods)
    machine.draw_rod(rod);
}

template <typename Frame>
coupling::Machine machine_on(const Scene &scene, Frame frame)
{
  coupling::MachineModel machine;
  machine.set_gravity(scene.gravity);
  machine.set_frame(std::move(frame));
  fill(machine, scene);
  return coupling::Machine(std::move(machine));
}

} // namespace

FramePath frame_path(const Scene &scene)
{
  const bool reduce = scene.reduction.reduces();
  switch (scene.frame.source)
  {
  case FrameSource::none:
    return FramePath::none;
  case FrameSource::parts:
    return FramePath::reduce;
  case FrameSource::geometry:
    return reduce ? FramePath::reduce : FramePath::sparse;
  case FrameSource::reduced_file:
    return FramePath::from_file;
  case FrameSource::matrices:
    break;
  }
  return reduce                                                 ? FramePath::reduce
         : scene.frame.matrices.M.rows() <= largest_dense_frame ? FramePath::dense
                                                                : FramePath::sparse;
}

coupling::Machine build_machine(const Scene &scene)
{
  if (scene.frame.source == FrameSource::matrices)
    return machine_on(scene, placed(scene.frame.place, [&] { return coupling::dense_frame(scene.frame.matrices); }));
  if (scene.bodies.empty())
    throw std::invalid_argument(scene.file + ": has nothing that moves; declare a [frame] or at least one [body.NAME]");
  coupling::MachineModel machine;
  machine.set_gravity(scene.gravity);
  fill(machine, scene);
  return coupling::Machine(std::move(machine));
}

coupling::Machine build_machine(const Scene &scene, coupling::ReducedFrame frame)
{
  return machine_on(scene, std::move(frame));
}

coupling::Machine build_machine(const Scene &scene, fem::FrameMatrices frame)
{
  return machine_on(scene, std::move(frame));
}

namespace
{

/// "-frame.crown.uz_rate"; names may have any length, which std::regex cannot take.
bool is_motion_of_interface(const std::string &path)
{
  static const std::regex motion("[ur][xyz](_rate|_acceleration)?");
  const std::size_t       first = path.find('.'), last = path.rfind('.');
  return (path.compare(0, first, "frame") == 0 || path.compare(0, first, "-frame") == 0) && last > first + 1 &&
         std::regex_match(path.substr(last + 1, 32), motion);
}

/// Of an interface, whose frame has no such motion.
void require_motion(const coupling::Signal &signal, const std::string &path)
{
  if (signal.on_q.empty() && signal.on_v.empty() && signal.on_a.empty() && is_motion_of_interface(path))
    throw std::invalid_argument("signal \"" + signal.name + "\": '" + path +
                                "' is always zero, for the frame has no such motion at this interface; name another "
                                "one, or leave the signal out");
}

} // namespace

std::vector<coupling::Signal> scene_signals(const Scene &scene, const coupling::Machine &machine)
{
  std::vector<coupling::Signal> signals;
  for (const auto &request : scene.signals)
  {
    signals.push_back(placed(request.place, [&] { return machine.signal(request.name, request.path); }));
    placed(request.place, [&] { require_motion(signals.back(), request.path); });
    signals.back().from = request.from;
  }
  return signals;
}

} // namespace gestell::apps
