#include "apps/scene/build/free_bodies.h"

#include "apps/scene/build/build_measures.h"
#include "mechanism/joints/orthonormal_directors.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <set>
#include <sstream>

namespace gestell::apps
{
namespace
{

/// Coordinates that elements, joints, springs, dampers and loads move by.
std::set<int> coordinates_in_use(const Scene &scene, const coupling::MachineModel &machine)
{
  std::set<int> used;
  const auto    add = [&used](const coupling::Measure &u)
  {
    for (const auto &[coordinate, weight] : u)
      used.insert(coordinate);
  };
  for (const auto &placement : machine.elements())
    std::for_each(placement.measures.begin(), placement.measures.end(), add);
  for (const LinearRequest &spring : scene.linear)
    add(measure_of(spring.u, machine));
  for (const LoadRequest &load : scene.loads)
    add(measure_of(load.u, machine));
  return used;
}

/// Whether the coordinate belongs to the body itself; the marker also moves with the carrier.
bool is_own(int coordinate, const coupling::Body &body)
{
  using coupling::BodyKind;
  const BodyKind kind   = body.kind;
  const bool     single = kind == BodyKind::rotor || kind == BodyKind::slider;
  const int      n      = single ? 1 : kind == BodyKind::rigid ? 3 + mechanism::OrthonormalDirectors::n_directors : 3;
  return coordinate >= body.coordinate && coordinate < body.coordinate + n;
}

} // namespace

std::vector<std::string> idle_bodies(const Scene &scene, const coupling::MachineModel &machine)
{
  std::vector<std::string> warnings;
  const auto               used  = coordinates_in_use(scene, machine);
  const auto               place = [&](const std::string &name)
  {
    const auto own =
        std::find_if(scene.bodies.begin(), scene.bodies.end(), [&](const auto &b) { return b.name == name; });
    return own == scene.bodies.end() ? std::string() : own->place + ": ";
  };
  for (const coupling::Body &body : machine.bodies())
    if (std::none_of(used.begin(), used.end(), [&](int c) { return is_own(c, body); }))
      warnings.push_back(place(body.name) + "only its weight acts on the body \"" + body.name +
                         "\": no element, joint or load names it; is one missing, or does one name another body?");
  return warnings;
}

namespace
{

Eigen::Vector3d middle_of(const coupling::MachineModel &machine, const std::string &marker)
{
  return vector(machine.position(marker));
}

bool has_place(const PlaceRequest &place)
{
  return !place.marker.empty() && place.marker != "ground";
}

/// Everything the scene places in space, but the joint itself.
Eigen::AlignedBox3d extent_without(const JointRequest &joint, const Scene &scene, const coupling::MachineModel &machine)
{
  Eigen::AlignedBox3d box;
  for (const coupling::Body &body : machine.bodies())
    box.extend(vector(body.position));
  for (const JointRequest &other : scene.joints)
    if (&other != &joint)
      for (const PlaceRequest *place : {&other.from, &other.to})
      {
        if (place->at)
          box.extend(vector(*place->at));
        if (has_place(*place))
          box.extend(middle_of(machine, place->marker));
      }
  for (const NamedPlace &other : scene.places)
    if (other.point.at)
      box.extend(vector(*other.point.at));
  return box;
}

} // namespace

std::vector<std::string> remote_joints(const Scene &scene, const coupling::MachineModel &machine)
{
  std::vector<std::string> warnings;
  for (const JointRequest &joint : scene.joints)
  {
    const auto &at = joint.from.at ? joint.from.at : joint.to.at;
    if (!at || !has_place(joint.from) || !has_place(joint.to))
      continue;
    const double nearer = std::min((vector(*at) - middle_of(machine, joint.from.marker)).norm(),
                                   (vector(*at) - middle_of(machine, joint.to.marker)).norm());
    const double others = extent_without(joint, scene, machine).diagonal().norm();
    if (nearer <= others || others == 0.) // of a machine with one place nothing is remote
      continue;
    std::ostringstream text;
    text.precision(3);
    text << joint.place << ": the point of the joint \"" << joint.name << "\" is " << nearer << " m from \""
         << joint.from.marker << "\" and \"" << joint.to.marker << "\", more than the size of the rest of the machine ("
         << others << " m); check the point and its unit";
    warnings.push_back(text.str());
  }
  return warnings;
}

bool may_float(const coupling::ReducedFrame &frame)
{
  return !frame.facts.free_motions.empty() || frame.n_rigid() > 0;
}

std::string free_frame(const Scene &scene, const coupling::MachineModel &machine,
                       const std::vector<coupling::Mode> &modes)
{
  const coupling::ReducedFrame *frame = machine.reduced_frame();
  if (!frame || !may_float(*frame))
    return "";
  const auto   n       = frame->M.rows();
  const double highest = std::max(frame->frequencies_hz.size() > 0 ? frame->frequencies_hz.maxCoeff() : 0.,
                                  modes.empty() ? 0. : modes.back().frequency_hz);
  const auto frees = [&](const coupling::Mode &mode)
  {
    const auto       q          = mode.shape.head(n);
    constexpr double takes_part = 0.01; // share of the kinetic energy of a motion: others only follow through springs
    // Relative to the highest frequency of the frame or the machine: lower frequencies are zero, because eigenvalues
    // have an accuracy of 1e-15 of the largest.
    constexpr double rounding = 1e-6;
    return mode.frequency_hz <= rounding * highest && mode.growth <= rounding * highest &&
           q.dot(frame->M * q) > takes_part;
  };
  if (std::none_of(modes.begin(), modes.end(), frees))
    return "";
  std::string ways;
  for (const std::string &name : frame->facts.free_motions)
    ways += (ways.empty() ? "" : ", ") + name;
  const bool falls = scene.gravity != Vector3{};
  return scene.frame.place + ": no support constrains the frame as a whole at the start, so that it " +
         (falls ? "falls under its weight" : "moves away under any load") +
         (ways.empty() ? "" : " (without elements its rigid-body modes are " + ways + ")") +
         "; give it a support ([frame.support.NAME]) or elements to the ground";
}

} // namespace gestell::apps
