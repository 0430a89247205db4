#include "apps/fmu/fmu_interface.h"

#include "apps/scene/build/build_machine.h"
#include "apps/scene/build/build_measures.h"
#include "apps/scene/file/parameters.h"
#include "apps/scene/language/parse_quantity.h"
#include "mechanism/elements/profile_force.h"
#include "mechanism/elements/speed_drive.h"
#include "mechanism/switched_element.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <stdexcept>

namespace gestell::apps
{
namespace
{

/// Also of an element that switches put in and take out; null if its law is another one.
template <typename Law>
const Law *law_of_request(const ElementRequest &request)
{
  const mechanism::ForceLaw *law = request.element.get();
  if (const auto *switched = dynamic_cast<const mechanism::SwitchedElement *>(law))
    law = &switched->law();
  return dynamic_cast<const Law *>(law);
}

std::shared_ptr<mechanism::InputValue> input_of(const ElementRequest &element)
{
  if (const auto *force = law_of_request<mechanism::ProfileForce>(element))
    return force->input();
  if (const auto *drive = law_of_request<mechanism::SpeedDrive>(element))
    return drive->input();
  return nullptr;
}

/// Signal of the input as it acts on the element.
std::string path_of_input(const ElementRequest &element)
{
  return element.name + (law_of_request<mechanism::SpeedDrive>(element) ? ".wanted_speed" : ".force");
}

/// Words that may be names of parameters.
void add_words(const std::string &text, std::set<std::string> &words)
{
  const auto in_word = [](unsigned char c) { return std::isalnum(c) || c == '_'; };
  for (std::size_t i = 0; i < text.size();)
  {
    std::size_t end = i;
    while (end < text.size() && in_word(static_cast<unsigned char>(text[end])))
      ++end;
    if (end > i)
      words.insert(text.substr(i, end - i));
    i = end + 1;
  }
}

void collect_words(const SceneNode &node, std::set<std::string> &words)
{
  if (node.type == SceneNode::Type::text)
    add_words(node.text, words);
  for (const SceneNode &element : node.elements)
    collect_words(element, words);
  for (const auto &entry : node.entries)
    collect_words(entry.second, words);
}

/// The variable with the dimension of its unit, for products of kg, m, s and rad.
FmuVariable with_unit(FmuVariable variable, const Dimension &dimension)
{
  const double exponents[] = {dimension[1], dimension[0], dimension[2]};
  for (int i = 0; i < 3; ++i)
    variable.base[i] = int(std::lround(exponents[i]));
  variable.base[3] = variable.unit.rfind("rad", 0) == 0 ? 1 : 0;
  return variable;
}

/// Variable of a signal with a unit such as "N m"; a unit that is not in the language has no dimension.
FmuVariable measured(const std::string &name, const std::string &unit, double start = 0.)
{
  const NameLookup no_names = [](const std::string &) { return std::optional<Quantity>(); };
  try
  {
    return with_unit({name, unit, start}, parse_quantity("1 " + unit, no_names).dimension);
  }
  catch (const std::invalid_argument &)
  {
    return {name, "", start};
  }
}

FmuVariable parameter_variable(const std::string &name, const Quantity &quantity)
{
  const bool whole = std::all_of(quantity.dimension.begin(), quantity.dimension.end(),
                                 [](double exponent) { return exponent == std::round(exponent); });
  const bool plain = !quantity.checked || equal(quantity.dimension, {});
  if (plain || !whole)
    return {name, "", quantity.value};
  return with_unit({name, describe(quantity.dimension), quantity.value}, quantity.dimension);
}

void erase_entry(SceneNode &table, const std::string &key)
{
  const auto is_it = [&](const SceneNode::Entry &entry) { return entry.first == key; };
  table.entries.erase(std::remove_if(table.entries.begin(), table.entries.end(), is_it), table.entries.end());
}

std::vector<FmuVariable> parameter_variables(const SceneNode &root, const std::set<std::string> &frozen)
{
  std::vector<FmuVariable> variables;
  const SceneNode         *table = root.find("parameters");
  if (!table)
    return variables;
  SceneNode without = root;
  erase_entry(without, "parameters");
  if (SceneNode *run = without.find("run"))
    erase_entry(*run, "end"); // does not limit the FMU
  const auto       used = parameters_in(without, table);
  const Parameters values(table);
  for (const auto &[name, value] : table->entries)
  {
    std::set<std::string> words;
    collect_words(value, words);
    const bool derived = std::any_of(table->entries.begin(), table->entries.end(),
                                     [&](const auto &other) { return words.count(other.first) > 0; });
    if (!derived && used.count(name) > 0 && frozen.count(name) == 0)
      variables.push_back(parameter_variable(name, *values.find(name)));
  }
  return variables;
}

/// A parameter that a signal is named like goes by its place in the scene.
void tell_names_apart(const Scene &scene, FmuInterface &interface)
{
  std::set<std::string> names;
  for (const auto *group : {&interface.inputs, &interface.outputs})
    for (const FmuVariable &variable : *group)
      if (!names.insert(variable.name).second)
        throw std::invalid_argument(scene.file + ": '" + variable.name +
                                    "' is an input and a signal; in an FMU names must be unique");
  for (FmuVariable &parameter : interface.parameters)
    if (names.count(parameter.name) > 0)
      parameter.name = "parameters." + parameter.name;
}

} // namespace

std::set<std::string> parameters_in(const SceneNode &table, const SceneNode *parameters)
{
  std::set<std::string> words, found;
  collect_words(table, words);
  for (bool more = parameters != nullptr; more;)
  {
    more = false;
    for (const auto &[name, value] : parameters->entries)
      if (words.count(name) > 0 && found.insert(name).second)
      {
        collect_words(value, words);
        more = true;
      }
  }
  return found;
}

std::vector<std::pair<std::string, InputHandles>> scene_inputs(const Scene &scene)
{
  std::vector<std::pair<std::string, InputHandles>> inputs;
  for (const ElementRequest &element : scene.elements)
    if (const auto input = input_of(element))
    {
      const auto known =
          std::find_if(inputs.begin(), inputs.end(), [&](const auto &other) { return other.first == input->name; });
      if (known != inputs.end())
        known->second.push_back(input);
      else
        inputs.push_back({input->name, {input}});
    }
  return inputs;
}

namespace
{

/// Refuses an input on a motion that the machine does not have, since its force would have no effect.
void require_coordinate(const Scene &scene, const ElementRequest &element, const coupling::Machine &machine)
{
  for (const MotionMeasure &motion : element.measures)
    if (measure_of(motion, machine.model()).empty())
      throw std::invalid_argument(scene.element_places.at(element.name) + ": element." + element.name +
                                  ": the input acts on a DOF that the machine does not have; use another coordinate");
}

} // namespace

FmuInterface fmu_interface(const SceneNode &root, const Scene &scene, const coupling::Machine &machine,
                           const std::set<std::string> &frozen)
{
  FmuInterface interface;
  interface.parameters = parameter_variables(root, frozen);
  for (const ElementRequest &element : scene.elements)
    if (const auto input = input_of(element))
    {
      require_coordinate(scene, element, machine);
      const std::string unit  = machine.signal(input->name, path_of_input(element)).unit;
      const auto        known = std::find_if(interface.inputs.begin(), interface.inputs.end(),
                                             [&](const FmuVariable &other) { return other.name == input->name; });
      if (known == interface.inputs.end())
        interface.inputs.push_back(measured(input->name, unit, input->value));
      else if (known->unit != unit || known->start != input->value)
        throw std::invalid_argument(scene.element_places.at(element.name) + ": the input '" + input->name + "' is in " +
                                    unit + " here and in " + known->unit +
                                    " elsewhere, or has another initial value there; use different names");
    }
  for (const coupling::Signal &signal : scene_signals(scene, machine))
    interface.outputs.push_back(measured(signal.name, signal.unit));
  tell_names_apart(scene, interface);
  return interface;
}

} // namespace gestell::apps
