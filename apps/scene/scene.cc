#include "apps/scene/scene.h"

#include "apps/scene/bodies/body_types.h"
#include "apps/scene/elements/element_types.h"
#include "apps/scene/file/expected_values.h"
#include "apps/scene/file/override_rules.h"
#include "apps/scene/file/scene_file.h"
#include "apps/scene/joints/joint_types.h"
#include "apps/scene/read/frame/node_interfaces.h"
#include "apps/scene/read/frame/read_frame.h"
#include "apps/scene/read/read_life.h"
#include "apps/scene/read/read_output.h"
#include "apps/scene/read/read_run.h"
#include "apps/scene/read/read_switches.h"
#include "apps/scene/scene_keys.h"
#include "apps/scene/values/requests.h"
#include "coupling/reduction/reductions.h"
#include "fem/values/nearest_name.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

namespace gestell::apps
{
namespace
{

using Unexpected = std::vector<UnexpectedValue>;

void look_at(const BodyRequest &body, Unexpected &found)
{
  constexpr double heaviest = 1e7, lightest = 1e-6; // kg: a ship's engine has 2e6
  if (body.mass > heaviest || (body.mass > 0. && body.mass < lightest))
    found.push_back({body.place,
                     "has a mass of " + short_text(body.mass) + " kg; expected: " + short_text(lightest) + " kg to " +
                         short_text(heaviest) +
                         " kg; numbers without a unit are in kg, others are written as \"3 t\", \"20 g\"",
                     std::max(body.mass / heaviest, lightest / body.mass)});
  const double arm = body.mass > 0. && body.inertia > 0. ? std::sqrt(body.inertia / body.mass) : 1.;
  // m, radius of gyration: chosen; no rotor is larger, none smaller than a watch's wheel
  constexpr double widest = 20., narrowest = 1e-4;
  if (arm > widest || arm < narrowest)
    found.push_back({body.place,
                     "has " + short_text(body.inertia) + " kg m^2 with " + short_text(body.mass) +
                         " kg, a radius of gyration of " + short_text(arm) + " m; expected: " + short_text(narrowest) +
                         " m to " + short_text(widest) +
                         " m; is its mass or inertia in another unit, such as \"40 kg mm^2\"?",
                     std::max(arm / widest, narrowest / arm)});
  const double     place    = std::hypot(body.position[0], body.position[1], body.position[2]);
  constexpr double farthest = 200.; // m: machines and their halls
  if (place > farthest)
    found.push_back({body.place,
                     "is " + short_text(place) + " m from the origin; expected: at most " + short_text(farthest) +
                         " m; numbers without a unit are in m, others are written as \"850 mm\"",
                     place / farthest});
}

bool turns(const Scene &scene, const std::string &coordinate)
{
  return std::any_of(scene.bodies.begin(), scene.bodies.end(),
                     [&](const BodyRequest &body)
                     { return body.name == coordinate && body.kind == coupling::BodyKind::rotor; });
}

/// Adds warnings about valid but implausible numbers, typically because of a missing or wrong unit: masses, radii of
/// gyration, positions, initial angles, gravity that acts upwards.
void warn_of_implausible_numbers(Scene &scene)
{
  Unexpected found;
  for (const BodyRequest &body : scene.bodies)
    look_at(body, found);
  constexpr double most_turns = 2.; // of a start: an angle in degrees has some hundred
  for (const NamedValue &angle : scene.start.q)
    if (const double turned = std::abs(angle.value) / (2. * M_PI); turns(scene, angle.name) && turned > most_turns)
      found.push_back({angle.place,
                       "is " + short_text(angle.value) + " rad, " + short_text(turned) + " turns; expected: at most " +
                           short_text(most_turns) +
                           " turns; numbers without a unit are in rad, others are written as \"120 deg\"",
                       turned / most_turns});
  warn_of_magnitudes(std::move(found), scene.warnings);
  const auto  &g      = scene.gravity;
  const double amount = std::hypot(g[0], g[1], g[2]);
  if (g[2] > 0.9 * amount && amount > 1.)
    scene.warnings.push_back(scene.file + ":1: gravity: acts upwards, along +z, with " + short_text(g[2]) +
                             " m/s^2; if z points up, write [0, 0, \"-9.81 m/s^2\"]");
}

/// Reads the name of a reduction and its keys in the table.
coupling::ReductionEntry read_reduction_method(const SceneTable &table)
{
  const auto        entries = coupling::Reductions::entries();
  const std::string name    = table.choice("method");
  const auto        own = std::find_if(entries.begin(), entries.end(), [&](const auto &e) { return e.name == name; });
  for (const auto &entry : entries)
    for (const std::string &key : entry.keys)
      if (table.has(key) && !own->takes(key))
        throw table.error(key, "is not for method = \"" + name + "\", " + own->title + "; remove it");
  return *own;
}

/// Parts are joined at their interfaces, which only one method keeps.
void require_method_of_parts(const SceneTable &table, const ReductionRequest &request)
{
  const std::string &method = request.options.method;
  if (!request.makes_frame)
    throw table.error("method", "\"" + request.method +
                                    "\" reduces the frame in one piece, but parts are joined after their reduction; "
                                    "remove it, or draw the frame in one piece");
  if (method != "craig-bampton")
    throw table.error(table.has("inside") ? "inside" : "method",
                      "'" + method +
                          "' does not retain the joined interfaces of parts; use \"craig-bampton\" for parts");
}

ReductionRequest read_reduction(const SceneTable &scene, const FrameRequest &frame)
{
  const bool       parts = frame.source == FrameSource::parts, made = parts || frame.source == FrameSource::geometry;
  const bool       reducible = made || frame.source == FrameSource::matrices;
  ReductionRequest request;
  request.method        = made ? request.options.method : "none";
  request.makes_frame   = made;
  request.options.place = scene.place();
  if (!scene.has("reduction"))
    return request;
  const SceneTable table = scene.table("reduction").declared(reduction_keys());
  if (!reducible)
    throw table.error("there is no frame to reduce; [frame] must give 'cad', parts or matrices");

  request.options.place     = table.place();
  const auto method         = read_reduction_method(table);
  request.method            = method.name;
  request.makes_frame       = method.makes == coupling::ReductionEntry::Makes::reduced_frame;
  request.options.tolerance = table.value("tolerance");
  if (table.has("modes"))
  {
    request.options.n_modes = table.whole("modes");
    if (request.options.n_modes < 0)
      throw table.error("modes", "needs a number of modes of zero or more; remove it for an automatic choice");
  }
  request.options.frequency = table.value_or("frequency", 0.);
  if (request.reduces())
    request.options.method = request.method;
  if (table.choice("inside") == "free-interface")
    request.options.method = "free-interface";
  if (parts)
    require_method_of_parts(table, request);
  if (method.makes == coupling::ReductionEntry::Makes::modes_of_machine)
  {
    coupling::SuperpositionOptions &modes = request.superposition.emplace();
    modes.n_modes                         = request.options.n_modes;
    modes.frequency                       = request.options.frequency;
    modes.tolerance                       = table.has("tolerance") ? request.options.tolerance : 0.;
    modes.diagonal_damping                = table.choice("damping") == "diagonal";
    modes.place                           = request.options.place;
    request.options                       = {}; // of the companion, which shows start and pictures
    request.options.frequency             = modes.frequency;
    request.options.place                 = table.place();
  }
  if (table.has("factor"))
    request.options.factor = table.choice("factor");
  request.options.eigensolver    = table.choice("eigensolver");
  request.options.inertia_relief = table.truth("inertia_relief");
  return request;
}

/// Whether a name may be a coordinate that is not a motion of a body or an interface: internal DOFs of the frame, the
/// directors of a rigid body, and lags of elements.  They are checked when the machine is built.
bool is_inner_coordinate(const std::string &name, const Names &names, const Scene &scene)
{
  for (const ElementRequest &element : scene.elements)
    for (const LagRequest &lag : element.lags)
      if (lag.name == name)
        return true;
  for (const std::string frame : {"frame mode ", "frame coordinate "})
    if (name.rfind(frame, 0) == 0)
      return true;
  const auto dot = name.rfind('.');
  if (dot == std::string::npos)
    return false;
  const BodyRequest *body = names.find_body(name.substr(0, dot));
  return body && body->kind == coupling::BodyKind::rigid && name.size() == dot + 4 && name[dot + 1] == 'd';
}

/// Value of a table { crank = "160 deg", "frame.crown.uz" = "-0.6 mm" } whose keys are coordinates.
std::vector<NamedValue> read_coordinates(const SceneTable &table, const Names &names, const Scene &scene, bool rates,
                                         bool rotors_only, bool measures)
{
  std::vector<NamedValue> values;
  for (const auto &key : table.keys())
  {
    const MeasureRequest    *measure = rotors_only || !measures ? nullptr : names.find_measure(key);
    const std::string        name    = measure ? key : names.coordinate(key);
    const bool               frame   = !rotors_only && name.rfind("frame.", 0) == 0;
    std::vector<std::string> valid;
    bool                     angle = name.size() > 2 && name[name.size() - 2] == 'r'; // frame.crown.rx
    for (const auto &coordinate : names.coordinates(rates))
    {
      const auto *body = names.find_body(coordinate.name);
      if (rotors_only && !(body && body->kind == coupling::BodyKind::rotor))
        continue;
      valid.push_back(coordinate.name);
      if (coordinate.name == name)
        angle = coordinate.angle;
    }
    if (measure)
    {
      valid.push_back(name);
      angle = measure->unit == "rad";
    }
    if (!rotors_only)
      for (const auto &interface : names.interfaces())
        for (const std::string motion : {"ux", "uy", "uz", "rx", "ry", "rz"})
          valid.push_back("frame." + interface + "." + motion);
    const bool inner = !rotors_only && is_inner_coordinate(name, names, scene);
    if (!frame && !inner && std::find(valid.begin(), valid.end(), name) == valid.end())
      throw table.error(key, "there is no " + std::string(rotors_only ? "rotor" : "coordinate") + " '" + name + "'" +
                                 suggestion(name, valid));
    if (frame && !names.interfaces().empty() && std::find(valid.begin(), valid.end(), name) == valid.end())
      throw table.error(key, "the frame has no coordinate '" + name + "'" + suggestion(name, valid));
    if (std::any_of(values.begin(), values.end(), [&](const NamedValue &other) { return other.name == name; }))
      throw table.error(key, "is the coordinate '" + name + "', which already has a value; give only one of them");
    if (inner) // in the unit of the coordinate itself
    {
      values.push_back({name, table.number(key, kind::number), table.place(key), false});
      continue;
    }
    const Kind &kind = rates ? (angle ? kind::angular_speed : kind::speed) : (angle ? kind::angle : kind::length);
    values.push_back({name, table.number(key, kind), table.place(key), measure != nullptr});
  }
  return values;
}

std::vector<NamedValue> read_optional_coordinates(const SceneTable &table, const std::string &key, const Names &names,
                                                  const Scene &scene, bool rates, bool rotors_only,
                                                  bool measures = false)
{
  const auto inner = table.optional_table(key);
  return inner ? read_coordinates(*inner, names, scene, rates, rotors_only, measures) : std::vector<NamedValue>{};
}

StartRequest read_start(const SceneTable &scene, const Names &names, const Scene &result)
{
  StartRequest start;
  start.place = scene.place();
  if (!scene.has("start"))
    return start;
  const SceneTable table   = scene.table("start").declared(start_keys());
  start.place              = table.place();
  const std::string rule   = table.choice("rule");
  const bool        rotors = table.has("angles") || table.has("speeds") || table.has("driver");
  start.periodic           = rule == "periodic";
  start.rule               = rule == "static"                                 ? StartRule::rest
                             : rule == "steady" || (start.periodic && rotors) ? StartRule::steady
                                                                              : StartRule::given;
  if (start.rule != StartRule::steady || !rotors)
  {
    if (start.rule == StartRule::rest)
      table.fill(start);
    start.q = read_optional_coordinates(table, "q", names, result, false, false, true);
    start.v = read_optional_coordinates(table, "v", names, result, true, false, true);
    return start;
  }
  for (const auto &angle : read_optional_coordinates(table, "angles", names, result, false, true))
    start.steady.angles.emplace_back(angle.name, angle.value);
  for (const auto &speed : read_optional_coordinates(table, "speeds", names, result, true, true))
    start.steady.speeds.emplace_back(speed.name, speed.value);
  if (table.has("driver"))
    start.steady.driver = names.body(table, "driver", coupling::BodyKind::rotor).name;
  if (start.steady.angles.size() != (start.steady.driver.empty() ? 0u : 1u))
    throw table.error("gives " + std::to_string(start.steady.angles.size()) + " angles and " +
                      (start.steady.driver.empty() ? "no driver" : "a driver") +
                      "; a given angle replaces the balance of the driver, so give both or neither");
  return start;
}

ModesRequest read_modes(const SceneTable &scene, const Names &names, const Scene &result)
{
  ModesRequest modes;
  if (!scene.has("modes"))
    return modes;
  const SceneTable table = scene.table("modes").declared(modes_keys());
  modes.at               = read_optional_coordinates(table, "at", names, result, false, false, true);
  table.fill(modes);
  if (modes.number < 0)
    throw table.error("number", "needs a number of modes of 1 or more, or 0 for none");
  if (table.has("open"))
    modes.open = table.texts("open");
  std::vector<std::string> elements;
  for (const auto &element : result.elements)
    elements.push_back(element.name);
  for (const auto &name : modes.open)
    if (std::find(elements.begin(), elements.end(), name) == elements.end())
      throw table.error("open", "there is no nonlinear element '" + name + "' to be open" + suggestion(name, elements));
  return modes;
}

void check_gravity(const SceneTable &table, const Scene &scene)
{
  const auto      &g              = scene.gravity;
  const double     amount         = std::hypot(g[0], g[1], g[2]);
  constexpr double strong_gravity = 100.; // [m/s^2] ten times the gravity of the earth
  if (amount > strong_gravity)
  {
    std::ostringstream text;
    text.precision(4);
    text << "is " << amount << " m/s^2, " << amount / 9.81
         << " times that of the Earth; numbers without a unit are in m/s^2, others are written as \"-9810 mm/s^2\"";
    table.warn("gravity", text.str());
  }
  if (scene.frame.source == FrameSource::matrices && !scene.frame.has_translations &&
      (g[0] != 0. || g[1] != 0. || g[2] != 0.))
    throw std::invalid_argument(scene.frame.place +
                                ": gravity acts on every row of the frame, but not every row is part of an interface; "
                                "give 'translations', the n x 3 matrix of q under a unit translation in x, y, z");
}

} // namespace

Scene read_scene(const std::string &path, const std::vector<std::string> &overrides, fem::Scripts scripts)
{
  return read_scene(read_scene_file(path, overrides), path, scripts);
}

Scene read_scene(const SceneNode &root, const std::string &path, fem::Scripts scripts)
try
{
  const Parameters parameters(root.find("parameters"));
  const SceneTable table = SceneTable(root, parameters, "").declared(scene_keys());
  table.has("parameters");
  table.has("extends"); // of the file itself, followed while reading it
  table.has("without");

  Scene scene;
  scene.file        = path;
  scene.name        = table.text("name", std::filesystem::path(path).stem().string());
  scene.description = table.text("description", "");
  if (scene.name.find('/') != std::string::npos || scene.name == "." || scene.name == "..")
    throw table.error("name", "must not contain '/': it names the folder of the results");
  scene.gravity                = table.vector_or("gravity", {});
  scene.frame                  = read_frame(table);
  scene.frame.geometry.scripts = scripts;
  for (coupling::FramePart &part : scene.frame.parts.parts)
    part.geometry.scripts = scripts;
  scene.reduction = read_reduction(table, scene.frame);
  check_gravity(table, scene);

  Names names(interface_names(scene.frame), scene.frame.source == FrameSource::reduced_file);
  scene.bodies = read_bodies(table, names, scripts);
  read_places(table, names, scene);
  read_elements(table, names, scene);
  read_joints(table, names, scene);
  read_switches(table, scene);
  scene.run   = read_run(table, scene.reduction.superposition.has_value());
  scene.start = read_start(table, names, scene);
  scene.modes = read_modes(table, names, scene);
  read_output(table, scene);
  read_life(table, scene);
  table.finish();
  parameters.refuse_idle_overrides();
  refuse_rotations_of_nodes(scene);
  scene.warnings = table.warnings();
  warn_of_implausible_numbers(scene);
  return scene;
}
catch (const IdleParameter &)
{
  throw;
}
catch (const std::invalid_argument &error)
{
  const std::string changes = parameter_changes_words(root, error.what());
  if (changes.empty())
    throw;
  throw std::invalid_argument(error.what() + changes);
}

} // namespace gestell::apps
