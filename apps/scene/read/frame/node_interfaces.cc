#include "apps/scene/read/frame/node_interfaces.h"

#include <cmath>
#include <stdexcept>

namespace gestell::apps
{
namespace
{

/// The interfaces of a frame from geometry, at their positions in the frame.
std::vector<fem::InterfaceSpecification> interfaces_of(const FrameRequest &frame)
{
  return frame.source == FrameSource::parts ? coupling::interfaces_in_frame(frame.parts) : frame.geometry.interfaces;
}

/// Looks through all that refers to markers.
class Search
{
public:
  explicit Search(const std::vector<fem::InterfaceSpecification> &interfaces)
  {
    for (const auto &interface : interfaces)
      if (interface.coupling == fem::InterfaceCoupling::node)
        nodes_["frame." + interface.name] = interface.position.value();
  }

  void look_at(const std::string &place) { place_ = place; }

  bool is_node(const std::string &marker) const { return nodes_.count(marker) > 0; }

  void refuse(const std::string &marker, const std::string &what) const
  {
    if (is_node(marker))
      throw std::invalid_argument(place_ + ": '" + marker + "' is a single mesh node without rotations, but " + what +
                                  "; set coupling = \"average\" for the interface, or use displacements only");
  }

  void look_at(const PlaceRequest &point) const
  {
    const auto node = nodes_.find(point.marker);
    if (node == nodes_.end() || !point.at)
      return;
    double squared = 0.;
    for (int d = 0; d < 3; ++d)
      squared += std::pow((*point.at)[d] - node->second[d], 2);
    constexpr double same_place = 1e-6; // [m] files have positions to micrometres
    if (squared > same_place * same_place)
      refuse(point.marker, "a point at a distance from it also moves with its rotation: remove 'at', or set it to the "
                           "'position' of the interface");
  }

  void look_at(const MotionMeasure &u) const
  {
    for (const MotionTerm &term : u)
      if (term.rotation)
        refuse(term.marker, "an angle of it is requested");
  }

  void look_at(const TermRequest &term) const
  {
    look_at(term.motion);
    if (term.placed)
      look_at(*term.placed);
  }

  void look_at(const MeasureRequest &measure) const
  {
    using Form = mechanism::RelativeMeasure::Form;
    for (const TermRequest &term : measure.terms)
      look_at(term);
    look_at(measure.argument);
    for (const PlaceRequest *point : {&measure.first, &measure.second})
    {
      look_at(*point);
      if (measure.terms.empty() && (measure.form == Form::angle || measure.form == Form::inclination))
        refuse(point->marker, "an angle of it is requested");
    }
  }

  void look_at(const JointRequest &joint) const
  {
    for (const PlaceRequest *point : {&joint.from, &joint.to})
    {
      look_at(*point);
      if (joint.holds_rotations)
        refuse(point->marker, "this joint constrains rotations; a spherical one does not");
    }
    look_at(joint.measure);
  }

  void look_at(const PairRequest &pair) const
  {
    for (const PlaceRequest *point : {&pair.from, &pair.to})
    {
      look_at(*point);
      if (pair.about)
        refuse(point->marker, "an angle of it is requested");
    }
  }

private:
  std::map<std::string, Vector3> nodes_; // markers of nodes, with the position used [m]
  std::string                    place_;
};

/// "frame.NAME.rx", "frame.NAME.rx_rate".
bool tells_rotation(const std::string &path, const std::string &marker)
{
  return path.rfind(marker + ".r", 0) == 0;
}

/// Refuses signals that are angles of nodes.
void look_at_signals(const Scene &scene, Search &search)
{
  for (const auto &interface : interfaces_of(scene.frame))
    for (const SignalRequest &signal : scene.signals)
      if (const auto tells = [&](const std::string &path) { return tells_rotation(path, "frame." + interface.name); };
          tells(signal.path) || std::any_of(signal.of.begin(), signal.of.end(), tells))
      {
        search.look_at(signal.place);
        search.refuse("frame." + interface.name, "an angle of it is requested");
      }
}

} // namespace

void refuse_rotations_of_nodes(const Scene &scene)
{
  Search     search(interfaces_of(scene.frame));
  const auto place_of = [&](const std::string &element)
  {
    const auto known = scene.element_places.find(element);
    return known == scene.element_places.end() ? "element '" + element + "'" : known->second;
  };
  for (const BodyRequest &body : scene.bodies)
    if (body.kind == coupling::BodyKind::rotor)
    {
      search.look_at(body.place);
      search.refuse(body.carrier, "a rotor's axis moves with the rotation of its carrier");
    }
  for (const LinearRequest &element : scene.linear)
  {
    search.look_at(place_of(element.name));
    search.look_at(element.u);
  }
  for (const LoadRequest &load : scene.loads)
  {
    search.look_at(place_of(load.name));
    search.look_at(load.u);
  }
  for (const ElementRequest &element : scene.elements)
  {
    search.look_at(place_of(element.name));
    for (const MotionMeasure &u : element.measures)
      search.look_at(u);
    if (element.pair)
      search.look_at(*element.pair);
    if (element.own)
      search.look_at(*element.own);
  }
  for (const NamedPlace &named : scene.places)
  {
    search.look_at(named.place);
    search.look_at(named.point);
  }
  for (const MeasureRequest &measure : scene.measures)
  {
    search.look_at(measure.place);
    search.look_at(measure);
  }
  for (const JointRequest &joint : scene.joints)
  {
    search.look_at(joint.place);
    search.look_at(joint);
  }
  for (const PointMassRequest &mass : scene.point_masses)
  {
    search.look_at(place_of(mass.name));
    if (mass.inertia != Vector3{} || mass.offset != Vector3{})
      search.refuse(mass.marker, "an inertia or an offset needs rotations");
  }
  look_at_signals(scene, search);
}

} // namespace gestell::apps
