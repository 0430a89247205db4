#include "tests/support/rescaled_scene.h"

#include "apps/reference/declared_tables.h"
#include "apps/scene/build/build_machine.h"
#include "apps/scene/scene.h"
#include "tests/support/node_values.h"
#include "tests/support/scaled_scene.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

namespace gestell::tests
{
namespace
{

using apps::Key;
using apps::Kind;
using apps::SceneNode;
using Type = SceneNode::Type;

double growth_of(const UnitPowers &powers, const apps::Dimension &dimension)
{
  double exponent = 0.;
  for (std::size_t i = 0; i < 3; ++i)
    exponent += powers[i] * dimension[i];
  return std::exp2(exponent);
}

bool is_plain(const SceneNode &value)
{
  return value.type == Type::integer || value.type == Type::real;
}

bool ends_with(const std::string &text, const std::string &end)
{
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

std::string text_of(const SceneNode &table, const std::string &key)
{
  const SceneNode *value = table.find(key);
  return value ? value->text : "";
}

/// Declared keys of a table: of its type, and those of every type.
std::vector<Key> keys_of(const std::string &family, const std::string &type = "")
{
  std::vector<Key> keys;
  for (const apps::DeclaredTable &table : apps::declared_tables())
    if (table.path == family || (!type.empty() && table.path == family + "." + type))
      keys = apps::joined({keys, table.keys});
  return keys;
}

class Rescaler
{
public:
  Rescaler(const SceneNode &scene, const UnitPowers &powers) : powers_(powers), original_(scene), restated_{scene, {}}
  {
  }

  Restated rescaled()
  {
    SceneNode &scene = restated_.scene;
    for (auto &[key, value] : scene.entries)
      if (key != "name" && key != "description")
        scale_texts(value);
    scale_numbers(scene, keys_of("scene"), false);
    for (const std::string kind : {"body", "measure", "joint", "element", "place"})
      if (SceneNode *tables = scene.find(kind))
        for (auto &[name, table] : tables->entries)
        {
          const std::vector<Key> keys = keys_of(kind, text_of(table, "type"));
          const bool             turn = turns(original_.find(kind)->find(name), kind);
          scale_numbers(table, keys, turn);
          add_defaults(table, keys, turn);
        }
    scale_frame();
    scale_switches();
    for (const std::string kind : {"run", "output"})
      if (SceneNode *table = scene.find(kind))
        scale_numbers(*table, keys_of(kind), false);
    if (SceneNode *start = scene.find("start"))
      for (const char *key : {"q", "v", "angles", "speeds"})
        if (SceneNode *values = start->find(key))
          scale_coordinates(*values, key[0] == 'v' || key[0] == 's');
    if (SceneNode *modes = scene.find("modes"))
      if (SceneNode *values = modes->find("at"))
        scale_coordinates(*values, false);
    set_scales();
    return std::move(restated_);
  }

private:
  // --- values

  static void scale_texts(SceneNode &value)
  {
    if (value.type == Type::text)
      value.text = test::scaled_expression(value.text);
    for (SceneNode &element : value.elements)
      scale_texts(element);
    for (auto &entry : value.entries)
      scale_texts(entry.second);
  }

  void scale(SceneNode &value, const Kind &kind) const
  {
    const double by = growth_of(powers_, kind.dimension);
    if (!is_plain(value) || by == 1.)
      return;
    SceneNode scaled = number_node(value.number * by);
    put_at(scaled, value);
    value = scaled;
  }

  /// Of the table that the key stands in, its keys: the kind of a first column is that of the argument.
  void scale(SceneNode &value, const Key &key, const std::vector<Key> &nearby, const SceneNode &table,
             bool turning) const
  {
    const Kind kind = kind_of(key, table, turning);
    scale(value, kind);
    if (value.type == Type::table)
      scale_numbers(value, keys_within(key, turning), turning);
    const bool rows = key.form == Key::Form::rows || (key.name == "table" && value.type == Type::array);
    for (SceneNode &element : value.elements)
      if (rows && element.elements.size() == 2)
      {
        scale(element.elements[0], argument(nearby, table, turning));
        scale(element.elements[1], kind);
      }
      else
        scale(element, key, nearby, table, turning);
  }

  /// A stiffness is one of N/m^n beside an exponent n.
  static Kind kind_of(const Key &key, const SceneNode &table, bool turning)
  {
    Kind kind = turning && key.angular ? *key.angular : key.kind;
    if (const SceneNode *n = table.find("exponent"); n && key.name == "stiffness" && !turning)
      kind.dimension[0] += 1. - n->number;
    return kind;
  }

  /// Keys of a table that is a value: levels of a force, and rates of these, are those of a torque on an angle.
  static std::vector<Key> keys_within(const Key &key, bool turning)
  {
    std::vector<Key> keys = key.keys;
    const auto      &from = key.kind.dimension;
    for (Key &own : keys)
      if (Kind kind = own.kind; turning && key.angular && !own.angular && kind.dimension[0] == from[0] && from[1] != 0.)
      {
        for (std::size_t i = 0; i < 3; ++i)
          kind.dimension[i] += key.angular->dimension[i] - from[i];
        own.angular = kind;
      }
    return keys;
  }

  static Kind argument(const std::vector<Key> &keys, const SceneNode &table, bool turning)
  {
    if (const std::string against = text_of(table, "against"); !against.empty())
      return against == "time"           ? apps::kind::time
             : against == "displacement" ? (turning ? apps::kind::angle : apps::kind::length)
             : turning                   ? apps::kind::angular_speed
                                         : apps::kind::speed;
    const Key *period = apps::find_key(keys, "period");
    return period ? (turning && period->angular ? *period->angular : period->kind) : apps::kind::number;
  }

  void scale_numbers(SceneNode &table, const std::vector<Key> &keys, bool turning) const
  {
    for (auto &[name, value] : table.entries)
      if (const Key *key = apps::find_key(keys, name))
        scale(value, *key, keys, table, turning);
  }

  /// What the program takes for granted in SI units where a key is left out.
  void add_defaults(SceneNode &table, const std::vector<Key> &keys, bool turning) const
  {
    for (const Key &key : keys)
    {
      const Kind &kind = turning && key.angular ? *key.angular : key.kind;
      const bool  one  = key.form == Key::Form::number || key.form == Key::Form::formula;
      if (!one || !key.fallback || !std::isfinite(*key.fallback) || *key.fallback == 0. || table.find(key.name))
        continue;
      if (const double by = growth_of(powers_, kind.dimension); by != 1.)
        table.entries.emplace_back(key.name, number_node(*key.fallback * by));
    }
  }

  // --- tables

  /// Whether the motion of a named body, measure or coordinate is an angle.
  bool is_angle(const std::string &path) const
  {
    for (const char *end : {".angle", ".rx", ".ry", ".rz", ".wx", ".wy", ".wz", ".r1", ".r2", ".speed"})
      if (ends_with(path, end))
        return true;
    const SceneNode *bodies = original_.find("body"), *measures = original_.find("measure");
    if (const SceneNode *body = bodies ? bodies->find(path) : nullptr)
      return text_of(*body, "type") == "rotor" || text_of(*body, "type") == "planar";
    if (const SceneNode *measure = measures ? measures->find(path) : nullptr)
      return turns(measure, "measure");
    return false;
  }

  bool turns(const SceneNode *table, const std::string &kind) const
  {
    const std::string type = text_of(*table, "type");
    if (kind == "measure" || kind == "joint")
    {
      static const std::set<std::string> angles{"angle", "inclination", "turn", "gear", "gear mesh"};
      if (angles.count(type))
        return true;
      if (type == "position function")
        return is_angle(text_of(*table, "to"));
      if (const SceneNode *terms = table->find("terms"); type == "sum" && !terms->elements.empty())
        return is_angle(text_of(terms->elements.front(), "of"));
    }
    if (table->find("about"))
      return true;
    if (table->find("direction"))
      return false;
    const std::string on = text_of(*table, "on");
    return is_angle(on.empty() ? text_of(*table, "from") : on);
  }

  void scale_frame()
  {
    SceneNode *frame = restated_.scene.find("frame");
    if (!frame)
      return;
    for (const char *matrix : {"mass", "stiffness", "damping"})
      if (const SceneNode *values = frame->find(matrix); values && values->type == Type::text)
        throw std::invalid_argument("rescaled(): the frame is in files");
    scale_numbers(*frame, keys_of("matrices"), false);
    scale_rotations(*frame);
    for (const std::string kind : {"interface", "cut", "support"})
      if (SceneNode *tables = frame->find(kind))
        for (auto &entry : tables->entries)
          scale_numbers(entry.second, keys_of("matrices." + kind), false);
  }

  /// Entries of rotations have a metre more for each.
  void scale_rotations(SceneNode &frame) const
  {
    std::set<std::size_t> turning;
    for (const auto &[name, interface] : frame.find("interface")->entries)
      if (const SceneNode *rows = interface.find("rows"))
        for (const auto &[motion, row] : rows->entries)
          if (motion.find('r') != std::string::npos)
            turning.insert(std::size_t(row.number) - 1);
    for (const char *key : {"mass", "stiffness", "damping"})
      if (SceneNode *matrix = frame.find(key))
        for (std::size_t i = 0; i < matrix->elements.size(); ++i)
          for (std::size_t k = 0; k < matrix->elements[i].elements.size(); ++k)
            scale(matrix->elements[i].elements[k], Kind{"", "", {double(turning.count(i) + turning.count(k)), 0, 0}});
  }

  /// Levels are values of signals, whose units the machine knows.
  void scale_switches()
  {
    SceneNode *switches = restated_.scene.find("switch");
    if (!switches)
      return;
    SceneNode          asking = original_;
    std::vector<Entry> watched;
    for (const auto &[name, table] : switches->entries)
      watched.emplace_back(name, text_node(text_of(table, "when")));
    table_of(asking, "output").entries.clear();
    table_of(table_of(asking, "output"), "signals").entries = watched;
    const apps::Scene       scene   = apps::read_scene(asking, "scene.toml", fem::Scripts::harmless);
    const coupling::Machine machine = apps::build_machine(scene);
    for (const coupling::Signal &signal : apps::scene_signals(scene, machine))
    {
      SceneNode &table = *switches->find(signal.name);
      scale_numbers(table, keys_of("switch"), false);
      for (const char *level : {"above", "below", "crosses", "hysteresis"})
        if (SceneNode *value = table.find(level))
          scale(*value, Kind{"", "", test::exponents(signal.unit)});
    }
  }
  using Entry = SceneNode::Entry;

  void scale_coordinates(SceneNode &values, bool rates) const
  {
    for (auto &[name, value] : values.entries)
    {
      apps::Dimension dimension{is_angle(name) ? 0. : 1., 0., rates ? -1. : 0.};
      scale(value, Kind{"", "", dimension});
    }
  }

  /// The parameters that scaled_expression() multiplies by.
  void set_scales()
  {
    SceneNode &parameters = table_of(restated_.scene, "parameters");
    for (std::size_t i = 0; i < 3; ++i)
      parameters.entries.emplace_back(test::scales[i], text_node("2^(" + std::to_string(powers_[i]) + ")*100 %"));
  }

  UnitPowers       powers_;
  const SceneNode &original_;
  Restated         restated_;
};

} // namespace

double growth(const UnitPowers &powers, const std::string &unit)
{
  return growth_of(powers, test::exponents(unit));
}

Restated rescaled(const SceneNode &scene, const UnitPowers &powers)
{
  return Rescaler(scene, powers).rescaled();
}

} // namespace gestell::tests
