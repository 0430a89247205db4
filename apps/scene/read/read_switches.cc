#include "apps/scene/read/read_switches.h"

#include "apps/scene/read/names.h"
#include "apps/scene/read/read_profile.h"
#include "fem/values/nearest_name.h"
#include "mechanism/elements/profile_force.h"
#include "mechanism/elements/spring_damper.h"
#include "mechanism/switched_element.h"

#include <algorithm>
#include <utility>

namespace gestell::apps
{
namespace
{

using mechanism::Formula;
using mechanism::SwitchedElement;

coupling::MeasureKind kind_of(const std::string &force_unit)
{
  return force_unit == "N m" ? coupling::MeasureKind::angle : coupling::MeasureKind::displacement;
}

ElementRequest element_of(const LinearRequest &spring)
{
  const mechanism::SpringDamper::Parameters parameters{spring.stiffness, spring.damping, spring.preload, spring.rest};
  ElementRequest element{spring.name, std::make_shared<mechanism::SpringDamper>(parameters), {spring.u}, "", {}};
  element.kind = kind_of(spring.force_unit);
  return element;
}

/// Moves the request of this name from the linear base system, where nothing can be switched, to the elements.
template <typename Requests>
void take_out(const std::string &name, Requests &requests, Scene &scene)
{
  const auto found =
      std::find_if(requests.begin(), requests.end(), [&](const auto &request) { return request.name == name; });
  if (found == requests.end())
    return;
  scene.elements.push_back(element_of(*found));
  requests.erase(found);
}

/// An element of the scene may be made of several, which are called NAME.front, NAME.rear.
std::vector<ElementRequest *> elements_called(const std::string &name, Scene &scene)
{
  take_out(name, scene.linear, scene);
  take_out(name, scene.loads, scene);
  std::vector<ElementRequest *> found;
  for (ElementRequest &element : scene.elements)
    if (element.name == name || element.name.rfind(name + ".", 0) == 0)
      found.push_back(&element);
  return found;
}

bool can_be_switched(const ElementRequest &element)
{
  return dynamic_cast<const SwitchedElement *>(element.element.get()) != nullptr;
}

void make_switched(const SceneTable &table, const std::string &key, ElementRequest &element,
                   SwitchedElement::Begin begin)
{
  if (can_be_switched(element))
    return;
  if (element.fixed)
    throw table.error(key, "'" + element.name +
                               "' cannot be switched off, because its fluid would remain; use \"set\" or \"hold\"");
  element.element = std::make_shared<SwitchedElement>(element.element, begin);
}

/// How the levels of a joint's motion are written; null if it has none.
std::shared_ptr<const ProfileKeys> levels_of(const JointRequest &joint)
{
  if (!joint.law)
    return nullptr;
  return std::make_shared<ProfileKeys>(joint.measure.unit == "rad" ? speed_profile() : path_profile());
}

/// Refuses an order that the element does not know, before keys of other orders are required.
void check_known(const SceneTable &table, const ElementRequest &element, const std::string &order)
{
  const auto known = command_names(*element.element);
  if (std::find(known.begin(), known.end(), order) == known.end())
    throw table.error("order", "'" + element.name + "' does not accept the command '" + order + "'; it accepts " +
                                   listed(known));
}

/// Refuses things that obey no orders, with the reason.
void refuse_unmoved(const SceneTable &table, const std::string &name, const std::string &order, const Scene &scene)
{
  for (const PointMassRequest &mass : scene.point_masses)
    if (mass.name == name)
      throw table.error("tell", "'" + name + "' is a mass, which cannot be switched");
  for (const JointRequest &joint : scene.joints)
    if (joint.name == name && (order == "on" || order == "off"))
      throw table.error("order",
                        "'" + name + "' is " + (joint.compliance ? "a compliant" : "an ideal") +
                            " joint, which cannot be released; use a \"clutch\" or a \"spring-damper\" instead");
}

/// A name that no element has must be that of a joint whose motion obeys the order.
void check_joint(const SceneTable &table, const std::string &name, const std::string &order, const Scene &scene)
{
  std::vector<std::string> obeying;
  const auto knows = [&](const auto &known) { return std::find(known.begin(), known.end(), order) != known.end(); };
  for (const JointRequest &joint : scene.joints)
  {
    if (joint.name == name && !joint.law)
      throw table.error("tell", "'" + name + "' is a joint without a 'motion', which accepts no commands");
    if (joint.name == name && !knows(joint.law->commands()))
      throw table.error("order",
                        "the motion of '" + name + "' does not accept the command '" + order +
                            (joint.law->commands().empty() ? "'; only motions with a 'speed' accept commands"
                                                           : "'; it accepts " + listed(joint.law->commands())));
    if (joint.name == name)
      return;
    if (joint.law && knows(joint.law->commands()))
      obeying.push_back(joint.name);
  }
  const bool switching = order == "on" || order == "off";
  for (const ElementRequest &element : scene.elements)
    if (switching ? !element.fixed : knows(command_names(*element.element)))
      obeying.push_back(element.name);
  for (const LoadRequest &load : scene.loads)
    if (switching || knows(mechanism::CommandedProfile::commands()))
      obeying.push_back(load.name);
  for (const LinearRequest &spring : scene.linear)
    if (switching)
      obeying.push_back(spring.name);
  throw table.error("tell",
                    "there is no element or joint '" + name + "'" +
                        (obeying.empty() ? ", and nothing that accepts '" + order + "'" : suggestion(name, obeying)));
}

std::vector<coupling::SwitchOrder> read_order(const SceneTable &table, Scene &scene)
{
  std::vector<coupling::SwitchOrder> orders;
  mechanism::SwitchCommand           order;
  order.name = table.text("order");
  for (const std::string &name : table.texts("tell"))
  {
    refuse_unmoved(table, name, order.name, scene);
    const auto elements = elements_called(name, scene);
    for (ElementRequest *element : elements)
    {
      if (order.name == "on" || order.name == "off" || !element->fixed)
        make_switched(table, "order", *element, SwitchedElement::Begin::on);
      check_known(table, *element, order.name);
    }
    std::shared_ptr<const ProfileKeys> levels = elements.empty() ? nullptr : elements.front()->levels;
    for (const JointRequest &joint : scene.joints)
      if (joint.name == name)
        levels = levels_of(joint);
    if (levels && (order.name == "set" || order.name == "brake"))
    {
      if (order.name == "set")
        order.level = table.number("to", levels->level);
      order.rate         = table.positive(levels->rate_key, levels->rate, order.rate);
      order.rate_of_rate = table.positive(levels->rate_of_rate_key, levels->rate_of_rate, order.rate_of_rate);
    }
    for (const ElementRequest *element : elements)
      orders.push_back({element->name, order});
    if (elements.empty())
    {
      check_joint(table, name, order.name, scene);
      orders.push_back({name, order});
    }
  }
  return orders;
}

/// The value, and the way on which the signal comes to it.
void read_crossing(const SceneTable &table, SwitchRequest &own)
{
  using coupling::SwitchCrossing;
  const std::pair<std::string, SwitchCrossing> ways[] = {
      {"above", SwitchCrossing::rising}, {"below", SwitchCrossing::falling}, {"crosses", SwitchCrossing::either}};
  std::string given;
  for (const auto &[key, crossing] : ways)
    if (table.has(key))
    {
      if (!given.empty())
        throw table.error(key, "cannot be given together with '" + given +
                                   "', but a switch has one threshold: give 'above' for a rising signal, 'below' for a "
                                   "falling one, or 'crosses' for both; two thresholds need two switches");
      given                = key;
      own.request.crossing = crossing;
    }
  if (given.empty())
    throw table.error("needs 'above', 'below' or 'crosses', the threshold at which it triggers");
  own.level         = table.quantity(given);
  own.request.level = own.level.value;
}

SwitchRequest read_switch(const SceneTable &any, Scene &scene)
{
  const SceneTable table = any.declared(switch_keys());
  SwitchRequest    own;
  own.place          = table.place();
  own.request.name   = table.name();
  own.request.signal = table.text("when");
  read_crossing(table, own);
  table.fill(own.request);
  own.request.after = table.text("after", "");
  if (own.request.repeat && own.request.signal == "t")
    throw table.error("repeat", "the time passes its threshold only once; remove it");
  if (table.has("hysteresis"))
  {
    own.hysteresis         = table.quantity("hysteresis");
    own.request.hysteresis = own.hysteresis->value;
    if (!own.request.repeat)
      throw table.error(
          "hysteresis",
          "is the distance that the signal must return before the switch triggers again; it needs repeat = true");
    if (own.request.hysteresis < 0.)
      throw table.error("hysteresis", "needs a value of zero or more");
  }
  if (table.has("orders") && (table.has("tell") || table.has("order")))
    throw table.error("orders", "means the same as 'tell' and 'order'; give only one of them");
  own.request.ends = table.text("ends", "");
  if (table.has("ends") && own.request.ends.empty())
    throw table.error("ends", "is empty; give a statement, such as \"the crane tips\"");
  const bool only_ends = table.has("ends") && !table.has("tell") && !table.has("order") && !table.has("orders");
  if (!table.has("orders") && !only_ends)
    own.request.orders = read_order(table, scene);
  for (const auto &part : table.table_array("orders"))
    for (const auto &order : read_order(part, scene))
      own.request.orders.push_back(order);
  if (own.request.orders.empty() && !only_ends)
    throw table.error("orders", "is empty; give commands such as [{ tell = \"motor\", order = \"off\" }]");
  return own;
}

/// Checks that the chain of switches `after` each other exists and is not circular.
void check_chain(const SceneTable &table, const std::vector<SwitchRequest> &switches)
{
  std::vector<std::string> names;
  for (const SwitchRequest &own : switches)
    names.push_back(own.request.name);
  std::string name = table.name();
  for (std::size_t passed = 0; passed <= switches.size(); ++passed)
  {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end())
      throw table.error("after", "there is no switch '" + name + "'" + suggestion(name, names));
    name = switches[found - names.begin()].request.after;
    if (name.empty())
      return;
  }
  throw table.error("after", "the switches wait for each other, so none would ever be armed; remove one 'after'");
}

} // namespace

namespace
{

/// Keys of one order.
std::vector<Key> order_keys()
{
  const ProfileKeys level = level_profile(kind::number, "1"), speed = path_profile();
  const auto        limit = [](const std::string &name, const Kind &kind, const std::string &meaning)
  { return key::number(name, kind, meaning).above_zero().by_default("a jump"); };
  return {
      key::plain("tell", Key::Form::texts, "target: name of an element or joint, or several").by_default("`orders`"),
      key::plain("order", Key::Form::text,
                 "the command: `\"on\"`, `\"off\"`, `\"set\"`, `\"brake\"`, `\"hold\"`, `\"start\"`")
          .by_default("`orders`"),
      key::plain("to", Key::Form::quantity, "level for `\"set\"`").by_default("required for `\"set\"`"),
      limit("rate", level.rate, "largest rate of change towards the level, in its unit"),
      limit("rate_of_rate", level.rate_of_rate, "largest rate of change of the rate"),
      limit("acceleration", speed.rate, "largest acceleration, for a speed").on_angle(speed_profile().rate),
      limit("jerk", speed.rate_of_rate, "largest jerk, for a speed").on_angle(speed_profile().rate_of_rate)};
}

Key crossing_key(const std::string &name, const std::string &meaning)
{
  return key::plain(name, Key::Form::quantity, meaning).by_default("one of the three is required");
}

} // namespace

const std::vector<Key> &switch_keys()
{
  static const std::vector<Key> keys = joined(
      {{key::plain("when", Key::Form::text, "signal, or `\"t\"`, the time"),
        crossing_key("above", "threshold, with its unit, that the signal exceeds; the switch triggers at once if the "
                              "signal is already above it when the switch is armed"),
        crossing_key("below", "threshold below which the signal falls; the switch triggers at once if the signal is "
                              "already below it when the switch is armed"),
        crossing_key(
            "crosses",
            "threshold that the signal crosses in either direction, starting from its side when the switch is armed")},
       order_keys(),
       {key::composed("orders", Key::Form::tables, kind::number, order_keys(),
                      "several commands at the same instant: `[{ tell = \"motor\", order = \"off\" }, { tell = "
                      "\"brake\", order = \"on\" }]`")
            .by_default("`tell` and `order`"),
        key::plain(
            "ends", Key::Form::text,
            "ends the run with this statement, such as `\"the crane tips\"`, and exit code 3; results so far are kept")
            .by_default("the run continues"),
        key::number("delay", kind::time, "delay from the crossing to the command")
            .from_zero()
            .by_default(&coupling::Switch::delay),
        key::named("after", "switch whose command arms this one").by_default("always"),
        key::truth("repeat", false, "trigger at every crossing").into(&coupling::Switch::repeat),
        key::plain("hysteresis", Key::Form::quantity,
                   "with `repeat`: the signal must first return past the threshold by this amount, or with `crosses` "
                   "move away from it in either direction")
            .by_default(0.)}});
  return keys;
}

ElementRequest element_of(const LoadRequest &load)
{
  Formula       f = load.constant;
  const Formula t = Formula::variable(0);
  for (const coupling::Oscillation &part : load.oscillations)
    f = f + part.amplitude * applied(mechanism::Function::sin, part.omega * t + part.phase);
  const auto     course = f.is_constant() ? mechanism::CommandedProfile(f.constant())
                                          : mechanism::CommandedProfile(mechanism::PositionFunction(f));
  ElementRequest element{load.name, std::make_shared<mechanism::ProfileForce>(course), {load.u}, "", {}};
  element.kind     = kind_of(load.force_unit);
  const Kind &kind = element.kind == coupling::MeasureKind::angle ? kind::torque : kind::force;
  element.levels   = std::make_shared<ProfileKeys>(level_profile(kind, kind.example));
  return element;
}

void begin_off(const SceneTable &table, Scene &scene)
{
  const auto elements = elements_called(table.name(), scene);
  if (elements.empty())
    throw table.error("initially", "it cannot be switched; remove it");
  for (ElementRequest *element : elements)
    make_switched(table, "initially", *element, SwitchedElement::Begin::off);
}

void read_switches(const SceneTable &scene, Scene &result)
{
  const auto tables = scene.tables("switch");
  for (const auto &table : tables)
  {
    check_thing_name(table);
    result.switches.push_back(read_switch(table, result));
  }
  for (const auto &table : tables)
    check_chain(table, result.switches);
}

} // namespace gestell::apps
