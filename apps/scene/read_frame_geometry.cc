#include "apps/scene/names.h"
#include "apps/scene/read_frame.h"
#include "apps/scene/read_material.h"
#include "coupling/nearest_name.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>

namespace gestell::apps
{
namespace
{

fem::SurfaceSelector read_surface(const SceneTable &table)
{
  fem::SurfaceSelector surface;
  surface.place = table.place();
  if (const auto cylinder = table.optional_table("cylinder"))
    surface.cylinder =
        fem::SurfaceSelector::Cylinder{cylinder->direction("axis"), cylinder->vector("through", kind::length),
                                       cylinder->positive("radius", kind::length)};
  if (const auto plane = table.optional_table("plane"))
    surface.plane = fem::SurfaceSelector::Plane{plane->direction("normal"), plane->vector("through", kind::length)};
  if (const auto box = table.optional_table("box"))
  {
    surface.box = fem::SurfaceSelector::Box{box->vector("min", kind::length), box->vector("max", kind::length)};
    for (int i = 0; i < 3; ++i)
      if (surface.box->min[i] > surface.box->max[i])
        throw box->error("'min' lies above 'max' in direction " + std::string(1, "xyz"[i]));
  }
  if (table.has("group"))
    surface.group = table.text("group");
  if (!surface.cylinder && !surface.plane && !surface.box && !surface.group)
    throw table.error("needs at least one of 'cylinder', 'plane', 'box', 'group' to select faces by");
  if (table.has("tolerance"))
    surface.tolerance = table.positive("tolerance", kind::length);
  surface.faces = table.is_text("faces") ? (table.choice("faces", {"any"}, "any"), 0) : table.integer("faces", 1);
  if (surface.faces < 1 && !table.is_text("faces"))
    throw table.error("faces", "needs the number of faces expected, 1 or more, or \"any\"");
  return surface;
}

/// Surfaces named by a support or an interface, under either key.
std::vector<std::string> read_surface_names(const SceneTable &table, const fem::FrameSpecification &frame)
{
  if (table.has("surface") && table.has("surfaces"))
    throw table.error("has both 'surface' and 'surfaces'; give one of them");
  const std::string        key   = table.has("surface") ? "surface" : "surfaces";
  const auto               names = table.texts(key);
  std::vector<std::string> declared;
  for (const auto &entry : frame.surfaces)
    declared.push_back(entry.first);
  std::set<std::string> seen;
  for (const auto &name : names)
  {
    if (!frame.surfaces.count(name))
      throw table.error(key,
                        "there is no [frame.surface." + written_key(name) + "]" + coupling::suggestion(name, declared));
    if (!seen.insert(name).second)
      throw table.error(key, "names '" + name + "' twice");
  }
  return names;
}

/// A scalar for all directions, or [x, y, z]; zero if missing.
fem::Vector3 per_direction(const SceneTable &table, const std::string &key, const Kind &kind)
{
  fem::Vector3 value{};
  if (table.is_array(key))
    value = table.vector(key, kind);
  else if (table.has(key))
    value.fill(table.number(key, kind));
  for (const double x : value)
    if (x < 0.)
      throw table.error(key, "needs " + with_article(kind) + " of zero or more in every direction");
  return value;
}

fem::Support read_support(const SceneTable &table, const fem::FrameSpecification &frame)
{
  check_thing_name(table);
  fem::Support support;
  support.name          = table.name();
  support.place         = table.place();
  support.surfaces      = read_surface_names(table, frame);
  const bool clamped    = table.boolean("clamped", false);
  const auto foundation = table.optional_table("foundation");
  const bool directions = table.has("directions");
  if (clamped == foundation.has_value())
    throw table.error("needs either 'clamped = true' or 'foundation = { stiffness = ..., damping = ... }'");
  if (directions && !clamped)
    throw table.error("directions", "belongs to a clamped support; a foundation takes stiffness = [x, y, z]");

  support.kind = clamped ? fem::SupportKind::clamped : fem::SupportKind::foundation;
  if (directions)
  {
    support.held = {false, false, false};
    for (const auto &name : table.texts("directions"))
      if (name == "x" || name == "y" || name == "z")
        support.held[name[0] - 'x'] = true;
      else
        throw table.error("directions", "there is no direction '" + name + "'; valid: 'x', 'y', 'z'");
  }
  if (foundation)
  {
    support.stiffness = per_direction(*foundation, "stiffness", kind::stiffness);
    support.damping   = per_direction(*foundation, "damping", kind::damping);
    if (support.stiffness == fem::Vector3{})
      throw foundation->error("needs a stiffness such as \"420 kN/mm\"");
  }
  return support;
}

fem::InterfaceSpecification read_interface(const SceneTable &table, const fem::FrameSpecification &frame)
{
  check_thing_name(table);
  fem::InterfaceSpecification interface;
  interface.name     = table.name();
  interface.place    = table.place();
  interface.surfaces = read_surface_names(table, frame);
  interface.coupling = table.choice("coupling", {"rigid", "average"}, "rigid") == "rigid"
                           ? fem::InterfaceCoupling::rigid
                           : fem::InterfaceCoupling::average;
  if (table.has("position"))
    interface.position = table.vector("position", kind::length);
  return interface;
}

fem::CutSpecification read_cut(const SceneTable &table)
{
  check_thing_name(table);
  const auto plane = table.table("plane");
  return {table.name(), plane.vector("through", kind::length), plane.direction("normal"), table.place()};
}

/// '*' stands for any letters, '?' for one.
bool matches(const std::string &pattern, const std::string &name, std::size_t p = 0, std::size_t n = 0)
{
  if (p == pattern.size())
    return n == name.size();
  if (pattern[p] == '*')
    return matches(pattern, name, p + 1, n) || (n < name.size() && matches(pattern, name, p, n + 1));
  return n < name.size() && (pattern[p] == '?' || pattern[p] == name[n]) && matches(pattern, name, p + 1, n + 1);
}

/// mesh = { size = "60 mm", "crown bearing *" = "30 mm" }: every other key is a pattern of surface names.
fem::MeshOptions read_mesh(const SceneTable &table, const fem::FrameSpecification &frame, bool is_mesh_file)
{
  fem::MeshOptions mesh;
  mesh.place     = table.place();
  mesh.size      = is_mesh_file ? table.positive("size", kind::length, 0.) : table.positive("size", kind::length);
  mesh.max_cells = table.positive("max_cells", kind::number, mesh.max_cells);
  std::vector<std::string> known{"size", "max_cells"};
  for (const auto &entry : frame.surfaces)
    known.push_back(entry.first);
  for (const auto &key : table.keys())
  {
    if (key == "size" || key == "max_cells")
      continue;
    bool any = false;
    for (const auto &entry : frame.surfaces)
      if (matches(key, entry.first))
        mesh.surface_size[entry.first] = table.positive(key, kind::length), any = true;
    if (!any)
      throw table.error(key, "is neither 'size' nor 'max_cells' nor the name of a surface" +
                                 coupling::suggestion(key, known));
  }
  return mesh;
}

/// A surface moves with one interface only, and an interface cannot move where the frame is clamped.
void check_overlaps(const SceneTable &frame, const fem::FrameSpecification &specification)
{
  std::map<std::string, std::string> owner;
  for (const auto &interface : specification.interfaces)
    for (const auto &surface : interface.surfaces)
      if (const auto [first, is_new] = owner.emplace(surface, "interface '" + interface.name + "'"); !is_new)
        throw std::invalid_argument(interface.place + ": surface '" + surface + "' belongs to " + first->second +
                                    " already; give each interface surfaces of its own");
  for (const auto &support : specification.supports)
    if (support.kind == fem::SupportKind::clamped)
      for (const auto &surface : support.surfaces)
        if (owner.count(surface))
          throw std::invalid_argument(support.place + ": surface '" + surface + "' is clamped, but belongs to " +
                                      owner.at(surface) + ", which must be free to move");
  if (specification.interfaces.empty())
    throw frame.error("has no interface; declare at least one [frame.interface.NAME] for the mechanism to act on");
}

/// The ratio of all modes, or Rayleigh's B = alpha M + beta C by the ratios at two frequencies:
/// zeta = (alpha/omega + beta omega)/2.
void read_damping(const SceneTable &damping, fem::FrameSpecification &specification)
{
  const auto ratio = [](const SceneTable &table)
  {
    const double zeta = table.not_negative("ratio", kind::number);
    if (zeta >= 1.)
      throw table.error("ratio", "a damping ratio of 1 or more leaves no vibration; steel frames have 0.01 to 0.03");
    return zeta;
  };
  if (!damping.has("rayleigh"))
  {
    specification.modal_damping_ratio = ratio(damping);
    return;
  }
  if (damping.has("ratio"))
    throw damping.error("rayleigh", "says how all modes are damped, as `ratio` does; leave out one of them");
  const auto pairs = damping.table_array("rayleigh");
  if (pairs.size() != 2)
    throw damping.error("rayleigh", "has " + std::to_string(pairs.size()) +
                                        " pairs; it needs two, [{ frequency = \"20 Hz\", ratio = 0.01 }, { ... }]");
  double omega[2], zeta[2];
  for (int i = 0; i < 2; ++i)
  {
    omega[i] = 2. * M_PI * pairs[i].positive("frequency", kind::frequency);
    zeta[i]  = ratio(pairs[i]);
  }
  if (!(omega[1] > omega[0]))
    throw pairs[1].error("frequency", "must lie above that of the first pair");
  const double squares             = omega[1] * omega[1] - omega[0] * omega[0];
  specification.rayleigh_stiffness = 2. * (zeta[1] * omega[1] - zeta[0] * omega[0]) / squares;
  specification.rayleigh_mass      = 2. * omega[0] * omega[1] * (zeta[0] * omega[1] - zeta[1] * omega[0]) / squares;
  if (specification.rayleigh_stiffness < 0. || specification.rayleigh_mass < 0.)
    throw damping.error("rayleigh", "would feed some vibrations instead of damping them: the two ratios differ by more "
                                    "than their frequencies do; bring them nearer to each other");
}

} // namespace

fem::FrameSpecification read_frame_geometry(const SceneTable &frame, const SceneTable &scene)
{
  fem::FrameSpecification specification;
  specification.place = frame.place();
  specification.cad   = frame.file("cad");

  auto ending = std::filesystem::path(specification.cad).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  const std::vector<std::string> endings{".step", ".stp", ".brep", ".geo", ".msh"};
  if (std::find(endings.begin(), endings.end(), ending) == endings.end())
    throw frame.error("cad", "a file ending in '" + ending + "' cannot be read; valid: " + coupling::listed(endings));
  specification.unit     = frame.positive("unit", kind::length, 0.);
  specification.material = read_material(frame, scene);
  if (const auto damping = frame.optional_table("damping"))
    read_damping(*damping, specification);

  for (const auto &table : frame.tables("surface"))
    specification.surfaces[table.name()] = read_surface(table);
  for (const auto &table : frame.tables("support"))
    specification.supports.push_back(read_support(table, specification));
  for (const auto &table : frame.tables("interface"))
    specification.interfaces.push_back(read_interface(table, specification));
  for (const auto &table : frame.tables("cut"))
    specification.cuts.push_back(read_cut(table));
  check_overlaps(frame, specification);
  specification.mesh = ending == ".msh" && !frame.has("mesh")
                           ? fem::MeshOptions{}
                           : read_mesh(frame.table("mesh"), specification, ending == ".msh");
  return specification;
}

} // namespace gestell::apps
