#include "apps/scene/joints/joint_types.h"

#include "apps/scene/file/scene_table.h"
#include "apps/scene/file/typed_table.h"
#include "apps/scene/joints/compliance.h"
#include "apps/scene/joints/joint_friction.h"

#include <algorithm>
#include <vector>

namespace gestell::apps
{
namespace
{

/// Names in a measure that refer to other measures; markers and bodies are not measures.
std::vector<std::string> named_by(const SceneTable &measure)
{
  std::vector<std::string> names;
  const auto               add = [&](const SceneTable &table, const char *key)
  {
    if (table.is_text(key))
      names.push_back(table.text(key));
  };
  if (!measure.is_text("type"))
    return names;
  if (const std::string type = measure.text("type"); type == "position function")
  {
    add(measure, "from");
    add(measure, "to");
  }
  else if (type == "sum")
    for (const SceneTable &term : measure.table_array("terms"))
      add(term, "of");
  return names;
}

/// Depth first, so that what is named comes first.
class Order
{
public:
  explicit Order(const std::vector<SceneTable> &measures) : measures_(measures), done_(measures.size(), false)
  {
    for (std::size_t i = 0; i < measures.size(); ++i)
      visit(i);
  }

  const std::vector<std::size_t> &indices() const { return indices_; }

private:
  void visit(std::size_t i)
  {
    if (done_[i])
      return;
    if (const auto begin = std::find(path_.begin(), path_.end(), i); begin != path_.end())
      refuse_cycle(begin);
    path_.push_back(i);
    for (const std::string &name : named_by(measures_[i]))
      for (std::size_t j = 0; j < measures_.size(); ++j)
        if (measures_[j].name() == name)
          visit(j);
    path_.pop_back();
    done_[i] = true;
    indices_.push_back(i);
  }

  [[noreturn]] void refuse_cycle(std::vector<std::size_t>::const_iterator begin) const
  {
    std::string cycle;
    for (auto i = begin; i != path_.end(); ++i)
      cycle += "'" + measures_[*i].name() + "' -> ";
    throw measures_[*begin].error("is defined by itself: " + cycle + "'" + measures_[*begin].name() +
                                  "'; define one of these by coordinates, or by measures of type \"along\", "
                                  "\"distance\", \"angle\" or \"inclination\"");
  }

  const std::vector<SceneTable> &measures_;
  std::vector<bool>              done_;
  std::vector<std::size_t>       path_, indices_;
};

/**
 * The order in which tables [measure.NAME] can be read: a sum or a position function follows the measures that it
 * names; the other measures keep the order of the file.
 * @return indices of `measures`
 * @throws std::invalid_argument for a circular definition, with the names of the cycle
 */
std::vector<std::size_t> reading_order(const std::vector<SceneTable> &measures)
{
  return Order(measures).indices();
}

} // namespace

using TypeOfJoint = JointType();

TypeOfJoint revolute_type, spherical_type, universal_type, cylindrical_type, rigid_type, prismatic_type, in_plane_type,
    distance_type, gear_type, position_function_type, screw_type, rolling_type, rack_type, gear_mesh_type,
    prescribed_motion_type;

const std::vector<JointType> &joint_types()
{
  static const auto types =
      with_type(made<JointType>(revolute_type, spherical_type, universal_type, cylindrical_type, rigid_type,
                                prismatic_type, in_plane_type, distance_type, gear_type, position_function_type,
                                screw_type, rolling_type, rack_type, gear_mesh_type, prescribed_motion_type));
  return types;
}

const JointType &joint_type(const std::string &name)
{
  return *std::find_if(joint_types().begin(), joint_types().end(), [&](const auto &type) { return type.name == name; });
}

const std::vector<Key> &place_keys()
{
  static const std::vector<Key> keys = {key::named("on", "body, frame.INTERFACE or ground that carries the marker"),
                                        key::vector("at", kind::length, "position in the reference configuration")};
  return keys;
}

namespace
{

/// A name of its own among all that signals refer to.
void check_new_name(const SceneTable &table, const Names &names, const Scene &scene)
{
  check_thing_name(table);
  const std::string name = table.name();
  if (names.find_body(name))
    throw table.error("a body has the name '" + name + "' too; their signals would have the same names");
  if (scene.element_places.count(name))
    throw table.error("the name '" + name + "' is used at " + scene.element_places.at(name) +
                      " too; their signals would have the same names");
}

MeasureRequest read_measure(const SceneTable &any, const Names &names)
{
  const MeasureType &type    = type_of(any, measure_types());
  MeasureRequest     measure = type.read(any.declared(type.keys), names);
  measure.name               = any.name();
  measure.place              = any.place();
  return measure;
}

/// @param any  its keys of other types are rejected with an explanation
JointRequest read_joint(const SceneTable &any, const Names &names)
{
  const JointType &type = type_of(any, joint_types());
  JointRequest     joint;
  joint.name            = any.name();
  joint.place           = any.place();
  joint.type            = type.name;
  joint.holds_rotations = type.holds_rotations;
  joint.compliance      = read_compliance(any, type);
  joint.friction        = read_joint_friction(any, type);
  type.read(any.declared(type.keys), names, joint);
  return joint;
}

} // namespace

void read_places(const SceneTable &scene, Names &names, Scene &result)
{
  for (const auto &table : scene.tables("place"))
  {
    check_thing_name(table);
    if (names.find_body(table.name()))
      throw table.error("a body has the name '" + table.name() + "' too; 'from' and 'to' would be ambiguous");
    const SceneTable   own = table.declared(place_keys());
    const PlaceRequest point{names.marker(own, "on"), own.vector("at")};
    names.add_place(table.name(), point);
    result.places.push_back({table.name(), point, table.place()});
  }
  const std::vector<SceneTable> measures = scene.tables("measure");
  result.measures.resize(measures.size());
  for (const std::size_t i : reading_order(measures))
  {
    const SceneTable &table = measures[i];
    check_new_name(table, names, result);
    result.measures[i]                  = read_measure(table, names);
    result.element_places[table.name()] = table.place();
    names.add_measure(result.measures[i]);
  }
}

void read_joints(const SceneTable &scene, const Names &names, Scene &result)
{
  for (const auto &table : scene.tables("joint"))
  {
    check_new_name(table, names, result);
    result.joints.push_back(read_joint(table, names));
    result.element_places[table.name()] = table.place();
  }
}

} // namespace gestell::apps
