#include "apps/scene/read/names.h"

#include "fem/values/nearest_name.h"

#include <algorithm>

namespace gestell::apps
{

Names::Names(const std::vector<std::string> &interfaces, bool any_interface)
    : interfaces_(interfaces), any_interface_(any_interface)
{
}

const BodyRequest *Names::find_body(const std::string &name) const
{
  const auto found = std::find_if(bodies_.begin(), bodies_.end(), [&](const auto &body) { return body.name == name; });
  return found == bodies_.end() ? nullptr : &*found;
}

void Names::set_carrier(const std::string &body, const std::string &carrier)
{
  for (BodyRequest &known : bodies_)
    if (known.name == body)
      known.carrier = carrier;
}

std::vector<std::string> Names::body_names() const
{
  std::vector<std::string> names;
  for (const auto &body : bodies_)
    names.push_back(body.name);
  return names;
}

std::string Names::marker(const SceneTable &table, const std::string &key) const
{
  const std::string name = table.text(key);
  if (name == "ground" || find_body(name))
    return name;
  auto valid = body_names();
  valid.push_back("ground");
  for (const auto &interface : interfaces_)
    valid.push_back("frame." + interface);
  if (std::find(valid.begin(), valid.end(), name) != valid.end() || (any_interface_ && name.rfind("frame.", 0) == 0))
    return name;
  if (const auto point = places_.find(name); point != places_.end())
    throw table.error(key, "'" + name + "' is a marker, but this key needs a whole body; name its body '" +
                               point->second.marker + "'");
  const bool of_frame = name.rfind("frame.", 0) == 0;
  throw table.error(key, of_frame ? "the frame has no interface '" + name.substr(6) + "'" +
                                        (interfaces_.empty()
                                             ? "; declare [frame.interface." + written_key(name.substr(6)) + "]"
                                             : suggestion(name.substr(6), interfaces_))
                                  : "there is no body '" + name + "'" + suggestion(name, valid));
}

std::string Names::marker(const SceneTable &table, const std::string &key, const std::string &fallback) const
{
  return table.has(key) ? marker(table, key) : fallback;
}

PlaceRequest Names::place(const SceneTable &table, const std::string &key, const std::string &at) const
{
  PlaceRequest      place;
  const std::string name = table.text(key);
  if (const auto named = places_.find(name); named != places_.end())
    place = named->second;
  else
    place.marker = marker(table, key);
  if (table.has(at))
    place.at = table.vector(at, kind::length);
  return place;
}

PlaceRequest Names::place(const SceneTable &table, const std::string &key, const std::string &at,
                          const std::string &fallback) const
{
  if (table.has(key))
    return place(table, key, at);
  PlaceRequest place{fallback, {}};
  if (table.has(at))
    place.at = table.vector(at, kind::length);
  return place;
}

const MeasureRequest *Names::find_measure(const std::string &name) const
{
  for (const MeasureRequest &measure : measures_)
    if (measure.name == name)
      return &measure;
  return nullptr;
}

const MeasureRequest &Names::measure(const SceneTable &table, const std::string &key) const
{
  const std::string name = table.text(key);
  if (const MeasureRequest *found = find_measure(name))
    return *found;
  if (find_body(name) || name.rfind("frame.", 0) == 0)
    throw table.error(key, "'" + name + "' is not a measure; a body or an interface is named by `from`");
  std::vector<std::string> valid;
  for (const MeasureRequest &measure : measures_)
    valid.push_back(measure.name);
  throw table.error(key,
                    "there is no measure '" + name + "'" +
                        (valid.empty() ? "; declare [measure." + written_key(name) + "]" : suggestion(name, valid)));
}

std::vector<Names::Coordinate> Names::coordinates(bool rates) const
{
  using coupling::BodyKind;
  std::vector<Coordinate> coordinates;
  for (const BodyRequest &body : bodies_)
  {
    if (body.kind == BodyKind::rotor || body.kind == BodyKind::slider)
      coordinates.push_back({body.name, body.kind == BodyKind::rotor});
    else if (body.kind == BodyKind::point || body.kind == BodyKind::rigid)
    {
      for (const char axis : {'x', 'y', 'z'})
        coordinates.push_back({body.name + ".u" + axis, false});
      for (const char axis : {'x', 'y', 'z'})
        if (body.kind == BodyKind::rigid) // a rotation as axis times angle, or the angular velocity
          coordinates.push_back({body.name + (rates ? ".w" : ".r") + axis, true});
    }
    else
    {
      const auto names = coupling::planar_coordinates(body.name, body.axis);
      for (int i = 0; i < 3; ++i)
        coordinates.push_back({names[i], i == 2});
    }
  }
  return coordinates;
}

const BodyRequest *Names::body_of_angle(const std::string &name) const
{
  const std::string  ending = ".angle";
  const std::size_t  end    = name.size() - std::min(name.size(), ending.size());
  const BodyRequest *body   = name.substr(end) == ending ? find_body(name.substr(0, end)) : nullptr;
  const bool turns = body && (body->kind == coupling::BodyKind::rotor || body->kind == coupling::BodyKind::planar);
  return turns ? body : nullptr;
}

std::string Names::coordinate(const std::string &name) const
{
  if (const BodyRequest *body = find_body(name))
    return body->kind == coupling::BodyKind::planar ? name + ".angle" : name;
  if (const BodyRequest *body = body_of_angle(name))
    return body->kind == coupling::BodyKind::rotor ? body->name : name;
  const auto         dot  = name.rfind(".displacement");
  const BodyRequest *body = dot == std::string::npos ? nullptr : find_body(name.substr(0, dot));
  return body && body->kind == coupling::BodyKind::slider && body->name + ".displacement" == name ? body->name : name;
}

const BodyRequest &Names::body(const SceneTable &table, const std::string &key, coupling::BodyKind kind) const
{
  const std::string  name  = table.text(key);
  const std::string  words = kind == coupling::BodyKind::rotor ? "rotor" : "slider";
  const BodyRequest *angle = body_of_angle(name), *found = angle ? angle : find_body(name);
  if (found && found->kind == kind)
    return *found;
  std::vector<std::string> valid;
  for (const auto &body : bodies_)
    if (body.kind == kind)
      valid.push_back(body.name);
  throw table.error(key, found ? "'" + name + "' is not a " + words + "; a " + words + " is needed here" +
                                     suggestion(name, valid)
                               : "there is no " + words + " '" + name + "'" + suggestion(name, valid));
}

void check_thing_name(const SceneTable &table)
{
  const std::string name = table.name();
  if (name.empty() || name.find('.') != std::string::npos || name[0] == '-')
    throw table.error("a name must not be empty, contain dots or begin with '-': signals refer to it as NAME.quantity");
  if (name == "frame" || name == "ground")
    throw table.error("'" + name + "' is a reserved name; choose another one");
}

} // namespace gestell::apps
