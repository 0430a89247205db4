#include "apps/session/exchange/scene_inputs.h"

#include "apps/scene/file/toml_text.h"
#include "apps/scene/file/written_text.h"
#include "fem/values/nearest_name.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <stdexcept>

namespace gestell::apps
{
namespace
{

/// A motion on which a force can act, as the keys of a force profile.
struct InputPlace
{
  std::string name, keys;
};

/// Keys of a displacement or rotation of a marker, "ux" ... "rz"; empty for other motions.
std::string motion_keys_of(const std::string &marker, const std::string &motion)
{
  const char *const axes[] = {"[1, 0, 0]", "[0, 1, 0]", "[0, 0, 1]"};
  if (motion.size() != 2 || (motion[0] != 'u' && motion[0] != 'r') || motion[1] < 'x' || motion[1] > 'z')
    return "";
  return "from = " + written_text(marker) + (motion[0] == 'u' ? ", direction = " : ", about = ") +
         axes[motion[1] - 'x'];
}

void add_body_places(const BodyRequest &body, std::vector<InputPlace> &places)
{
  using coupling::BodyKind;
  const std::string from = "from = " + written_text(body.name);
  if (body.kind == BodyKind::rotor || body.kind == BodyKind::slider)
  {
    places.push_back({body.name, from});
    return;
  }
  for (const char *const motion : {"ux", "uy", "uz"})
    places.push_back({body.name + "." + motion, motion_keys_of(body.name, motion)});
  const auto &[x, y, z] = body.axis;
  if (body.kind == BodyKind::planar)
    places.push_back({body.name + ".angle",
                      from + ", about = [" + exact_text(x) + ", " + exact_text(y) + ", " + exact_text(z) + "]"});
}

/// Places of forces. For the frame any name of this form is accepted: the reader of interfaces checks it.
std::vector<InputPlace> force_places(const Scene &scene, const std::string &requested)
{
  std::vector<InputPlace> places;
  for (const BodyRequest &body : scene.bodies)
    add_body_places(body, places);
  const std::size_t dot = requested.rfind('.');
  if (requested.rfind("frame.", 0) == 0 && dot > 5)
    if (const std::string keys = motion_keys_of(requested.substr(0, dot), requested.substr(dot + 1)); !keys.empty())
      places.push_back({requested, keys});
  return places;
}

/// A profile of an element that an input may replace.
struct InputCourse
{
  std::string name; ///< "drive.speed"
  SceneNode  *element;
  std::string key, initial;
};

std::vector<InputCourse> courses(SceneNode &root)
{
  std::vector<InputCourse> found;
  if (SceneNode *elements = root.find("element"))
    for (auto &[name, element] : elements->entries)
      if (const SceneNode *type = element.find("type"))
      {
        if (type->text == "speed drive")
          found.push_back({name + ".speed", &element, "speed", "initial_speed"});
        if (type->text == "force profile")
          found.push_back({name + ".profile", &element, "profile", "initial"});
      }
  return found;
}

void set_entry(SceneNode &table, const std::string &key, const SceneNode &value)
{
  if (SceneNode *entry = table.find(key))
    *entry = value;
  else
    table.entries.emplace_back(key, value);
}

SceneNode parsed_keys(const std::string &text, const Place &place, const std::string &folder)
{
  const auto node = parse_toml_value(text, place, folder);
  if (!node)
    throw std::invalid_argument(place.text() + ": names with these characters cannot be inputs");
  return *node;
}

/// The constant level of a profile becomes the initial value of the input.
void follow_input(const InputCourse &course, const SceneNode &input)
{
  const SceneNode *before = course.element->find(course.key);
  if (before && (before->type == SceneNode::Type::integer || before->type == SceneNode::Type::real ||
                 before->type == SceneNode::Type::text))
    set_entry(*course.element, course.initial, SceneNode(*before));
  set_entry(*course.element, course.key, input);
}

/// Names of elements have no dots.
std::string element_of_input(std::string name)
{
  std::replace(name.begin(), name.end(), '.', ' ');
  return "input " + name;
}

void add_input(const std::string &requested, const Scene &scene, SceneNode &root)
{
  const std::size_t equals = requested.find('=');
  const std::string where  = equals == std::string::npos ? requested : requested.substr(equals + 1),
                    name   = requested.substr(0, equals);
  const Place              place{"--inputs " + requested};
  std::vector<std::string> known;
  const std::string        input = "{ input = " + written_text(name) + " }";
  for (const InputCourse &course : courses(root))
  {
    if (course.name == where)
      return follow_input(course, parsed_keys(input, place, root.folder));
    known.push_back(course.name);
  }
  for (const InputPlace &motion : force_places(scene, where))
  {
    if (motion.name != where)
    {
      known.push_back(motion.name);
      continue;
    }
    if (!root.find("element"))
      set_entry(root, "element", parsed_keys("{}", place, root.folder));
    SceneNode &elements = *root.find("element");
    if (elements.find(element_of_input(name)))
      place.fail("there is an input '" + name + "' already; use different names, such as F2=" + where);
    set_entry(
        elements, element_of_input(name),
        parsed_keys("{ type = \"force profile\", " + motion.keys + ", profile = " + input + " }", place, root.folder));
    return;
  }
  known.push_back("frame.INTERFACE.uz");
  place.fail("there is no marker '" + where + "' for an input" + suggestion(where, known));
}

} // namespace

void add_scene_inputs(const std::vector<std::string> &inputs, const Scene &scene, SceneNode &root)
{
  for (const std::string &input : inputs)
    add_input(input, scene, root);
}

} // namespace gestell::apps
