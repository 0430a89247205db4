#include "apps/reference/declared_tables.h"

#include "apps/scene/bodies/body_types.h"
#include "apps/scene/elements/element_types.h"
#include "apps/scene/joints/compliance.h"
#include "apps/scene/joints/joint_friction.h"
#include "apps/scene/joints/joint_keys.h"
#include "apps/scene/joints/joint_types.h"
#include "apps/scene/read/frame/geometry_keys.h"
#include "apps/scene/read/frame/matrix_keys.h"
#include "apps/scene/read/frame/read_frame.h"
#include "apps/scene/read/read_contact.h"
#include "apps/scene/read/read_function.h"
#include "apps/scene/read/read_life.h"
#include "apps/scene/read/read_material.h"
#include "apps/scene/read/read_motion.h"
#include "apps/scene/read/read_output.h"
#include "apps/scene/read/read_part.h"
#include "apps/scene/read/read_run.h"
#include "apps/scene/read/read_switches.h"
#include "apps/scene/read/relative_motion.h"
#include "apps/scene/scene_keys.h"
#include "fem/values/nearest_name.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>

namespace gestell::apps
{
namespace
{

using Tables = std::vector<DeclaredTable>;

template <class Type>
void add_types(Tables &tables, const std::string &family, const std::vector<Type> &types)
{
  for (const Type &type : types)
    tables.push_back(
        {family + "." + type.name, "[" + family + ".NAME]", type.name, type.does, type.signals, type.keys, {}});
}

void add_frame(Tables &tables)
{
  const auto add = [&](const std::string &path, const std::string &heading, const std::string &does,
                       const std::vector<Key> &keys) {
    tables.push_back({path, heading, "", does, "", keys, {}});
  };
  add("frame", "[frame]", "Frame from CAD or a mesh, or already reduced; without it the machine is on rigid ground.",
      frame_keys());
  add("frame.mesh", "mesh of [frame]",
      "Mesh; every other key is a pattern of surface names with the element size there.", mesh_keys());
  add("frame.surface", "[frame.surface.NAME]",
      "Named selection of faces by their geometry; all given conditions must be met.", surface_keys());
  add("frame.support", "[frame.support.NAME]", "Support of surfaces, `clamped` or on an elastic `foundation`.",
      support_keys());
  add("frame.interface", "[frame.interface.NAME]",
      "Interface `frame.NAME` to the mechanism: a node with six DOFs, with `coupling = \"node\"` three.",
      interface_keys());
  add("frame.mass", "[frame.mass.NAME]", "Rigid body fastened to the frame, such as a motor or a counterweight.",
      attached_mass_keys());
  add("frame.cut", "[frame.cut.NAME]",
      "Cut plane; signals `frame.cut.NAME`: transmitted force along the normal, tension positive, and `V1`, `V2`, `T`, "
      "`M1`, `M2`.",
      cut_keys());
  add("frame.stress_point", "[frame.stress_point.NAME]",
      "Stress at a point of the surface; signals `frame.stress.NAME.xx` to `xz` and `normal`.", stress_point_keys());
  add("parts", "[frame]", "Frame in several parts, which are reduced separately and then joined.", parts_frame_keys());
  add("frame.part", "[frame.part.NAME]",
      "Part of the frame, with its own surfaces, interfaces `frame.NAME.INTERFACE`, supports, masses and cuts.",
      frame_part_keys());
  add("frame.joint", "[frame.joint.NAME]",
      "Joint of two parts; signals `frame.joint.NAME.fx` to `mz` and `normal_force`, for a tie rod `force`.",
      frame_joint_keys());
  add("matrices", "[frame]", "Frame given by matrices, M q'' + B q' + C q = f.", matrix_frame_keys());
  add("matrices.file_units", "[frame.file_units]", "Units in the files of another program.", file_unit_keys());
  add("matrices.interface", "[frame.interface.NAME]", "Interface: rows of the matrices that are DOFs of a node.",
      matrix_interface_keys());
  for (const OutputFamily &family : output_families())
    add("matrices." + family.name, "[frame." + family.name + ".NAME]",
        "Signal `frame." + family.name + ".NAME` for a frame given by matrices, and a table for each component.",
        family.keys);
  add("material", "[material.NAME]", "Material of the frame and of bodies from CAD.", material_keys());
  add("reduction", "[reduction]", "Reduction of the frame.", reduction_keys());
}

void add_rest(Tables &tables)
{
  const auto add = [&](const std::string &path, const std::string &heading, const std::string &does,
                       const std::vector<Key> &keys) {
    tables.push_back({path, heading, "", does, "", keys, {}});
  };
  add("switch", "[switch.NAME]", "Switch: sends a command to elements or joints when a signal crosses a threshold.",
      switch_keys());
  add("start", "[start]", "Initial state of the run; without it all coordinates and velocities are zero.",
      start_keys());
  add("run", "[run]", "Time integration.", run_keys());
  add("modes", "[modes]", "Modes of the coupled machine with closed contacts.", modes_keys());
  add("output", "[output]", "Signals, and the intervals of rows and pictures.", output_keys());
  add("output.signal", "[output.signals.NAME]", "Signal whose extremes count after an event.", watched_signal_keys());
  add("output.stress", "[output.stress]",
      "Stresses at the skin of a frame from `cad`; an empty table means the largest stress.", stress_keys());
  add("output.stages", "[output.stages]",
      "Stages of the run between events, and identified vibrations of the last one.", stage_keys());
  add("life", "[life]", "Fatigue of the frame under the motion of the run.", life_keys());
  add("life.curve", "curve of [life]", "S-N curve.", curve_keys());
  add("life.weld", "[[life.weld]]", "Weld, or a part of the skin judged by its own stress.", weld_keys());
  add("life.block", "[[life.block]]", "Further run of the load spectrum.", block_keys());
}

Tables make_tables()
{
  Tables tables;
  tables.push_back({"scene", "", "", "Top-level keys.", "", scene_keys(), {}});
  add_frame(tables);
  for (const BodyType &type : body_types())
    tables.push_back({"body." + type.name, "[body.NAME]", type.name, type.does, "", type.keys, {}});
  tables.push_back(
      {"place", "[place.NAME]", "", "Marker: a point of a body, an interface or the ground.", "", place_keys(), {}});
  add_types(tables, "measure", measure_types());
  add_types(tables, "joint", joint_types());
  tables.push_back(
      {"element", "[element.NAME]", "", "Common keys of every [element.NAME].", "", common_element_keys(), {}});
  for (const ElementType &type : element_types())
    tables.push_back(
        {"element." + type.name, "[element.NAME]", type.name, type.does, type.signals, type.keys, type.examples});
  add_rest(tables);
  return tables;
}

std::string unit_of(const Kind &kind)
{
  if (equal(kind.dimension, kind::frequency.dimension))
    return kind.refused == Counts::radians ? "[Hz]" : "[rad/s]";
  if (equal(kind.dimension, {}))
    return kind.refused == Counts::turns ? "[rad]" : "";
  const auto angle = kind.example.find("/rad"); // per radian
  return "[" + describe(kind.dimension) + (angle == std::string::npos ? "" : kind.example.substr(angle)) + "]";
}

std::string kind_text(const Kind &kind)
{
  const std::string unit = unit_of(kind);
  return kind.name + (unit.empty() ? "" : " " + unit);
}

std::string range_text(Key::Range range)
{
  switch (range)
  {
  case Key::Range::above_zero:
    return ", above 0";
  case Key::Range::from_zero:
    return ", 0 or more";
  case Key::Range::share:
    return ", above 0, at most 1";
  case Key::Range::any:
    break;
  }
  return "";
}

/// " with a, b" for a table; empty if its keys are declared separately.
std::string of_keys(const Key &key)
{
  return key.keys.empty() ? "" : " with " + quoted_names(key.keys);
}

std::string form_text(Key::Form form, const Key &key, const std::string &kinds)
{
  switch (form)
  {
  case Key::Form::number:
    return kinds;
  case Key::Form::formula:
    return "formula, " + kinds;
  case Key::Form::profile:
  case Key::Form::course:
    return kinds + ", or ramps" + (form == Key::Form::course ? ", or a function" : "") + ", with " +
           quoted_names(key.keys);
  case Key::Form::truth:
    return "true or false";
  case Key::Form::choice:
    return "one of " + listed(key.choices);
  case Key::Form::name:
    return "name";
  case Key::Form::direction:
    return "direction [x, y, z]";
  case Key::Form::vector:
    return "[x, y, z]: " + kinds;
  case Key::Form::rows:
    return "list of pairs, second value: " + kinds;
  case Key::Form::whole:
    return "integer";
  case Key::Form::quantity:
    return "value with unit";
  case Key::Form::numbers:
    return "list of values: " + kinds;
  case Key::Form::matrix:
    return "matrix (list of rows): " + kinds;
  case Key::Form::text:
    return "string";
  case Key::Form::texts:
    return "string or list of strings";
  case Key::Form::file:
    return "file";
  case Key::Form::table:
    return "table" + of_keys(key);
  case Key::Form::map:
    return "table {name = value}" + (key.keys.empty() ? "" : ", with keys " + quoted_names(key.keys));
  case Key::Form::tables:
    return "list of tables with " + quoted_names(key.keys);
  case Key::Form::coefficient:
    return kinds + ", or a table with " + quoted_names(key.keys);
  }
  return "";
}

/// Keys of a type of elements that other types have as well.
std::vector<Key> keys_of(const std::string &type, const std::vector<std::string> &names)
{
  std::vector<Key> keys;
  for (const ElementType &element : element_types())
    for (const Key &key : element.keys)
      if (element.name == type && std::find(names.begin(), names.end(), key.name) != names.end())
        keys.push_back(key);
  return keys;
}

} // namespace

const std::vector<DeclaredTable> &declared_tables()
{
  static const std::vector<DeclaredTable> tables = make_tables();
  return tables;
}

const std::vector<KeyGroup> &key_groups()
{
  static const std::vector<KeyGroup> groups = {
      {{"body"}, "Body from CAD", part_keys()},
      {{"measure", "joint"}, "Position function", position_function_keys()},
      {{"measure"}, "Points of a measure", place_on_ground()},
      {{"joint"}, "Points of a joint", one_point()},
      {{"joint"}, "Motion over time", motion_law_keys(), "motion"},
      {{"joint"}, "Compliance of a joint", compliance_keys()},
      {{"joint"}, "Friction of a joint", joint_friction_key().keys, "friction"},
      {{"element"}, "Motion of an element", motion_keys()},
      {{"element"}, "Shaft of a motor", shaft_keys()},
      {{"element"},
       "Asynchronous motors",
       keys_of("dynamic motor", {"breakdown_torque", "breakdown_slip", "synchronous_speed", "ratio"})},
      {{"element"}, "Friction curve", keys_of("friction", {"stribeck_speed", "stribeck_exponent", "viscous"})},
      {{"element"},
       "Engagement",
       keys_of("brake", {"capacity", "static_capacity", "engagement", "initial_engagement", "waits"})},
      {{"element"}, "Bearing", keys_of("rolling bearing", {"from", "to", "at", "at_from", "at_to", "axis"})},
      {{"element"}, "Stiffness of a contact", contact_keys()},
      {{"element"}, "Friction of a contact", sliding_friction_key().keys, "friction"}};
  return groups;
}

std::string quoted_names(const std::vector<Key> &keys)
{
  std::string names;
  for (const Key &key : keys)
    names += (names.empty() ? "`" : ", `") + key.name + "`";
  return names;
}

std::string taken_by(const Key &key)
{
  const std::string angular = key.angular ? ", about an axis " + kind_text(*key.angular) : "";
  std::string       text    = form_text(key.form, key, kind_text(key.kind) + angular) + range_text(key.range);
  for (const Key::Form form : key.others)
    text += ", or " + form_text(form, key, kind_text(key.kind) + angular);
  return text;
}

std::string default_of(const Key &key)
{
  if (key.demanded)
    return "required";
  if (key.form == Key::Form::choice)
    return "\"" + key.choices.front() + "\"";
  if (key.form == Key::Form::truth)
    return key.fallback.value_or(0.) != 0. ? "true" : "false";
  if (key.fallback)
    return std::isfinite(*key.fallback) ? exact_text(*key.fallback) : "none";
  return key.otherwise;
}

} // namespace gestell::apps
