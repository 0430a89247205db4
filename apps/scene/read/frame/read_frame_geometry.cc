#include "apps/scene/read/frame/geometry_keys.h"
#include "apps/scene/read/frame/read_damping.h"
#include "apps/scene/read/frame/read_dimensions.h"
#include "apps/scene/read/frame/read_frame.h"
#include "apps/scene/read/names.h"
#include "apps/scene/read/read_material.h"
#include "apps/scene/read/read_tensor.h"
#include "fem/values/nearest_name.h"

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

fem::SurfaceSelector read_surface(const SceneTable &any)
{
  const SceneTable     table = any.declared(surface_keys());
  fem::SurfaceSelector surface;
  surface.place = table.place();
  if (const auto cylinder = table.optional_table("cylinder"))
    surface.cylinder = fem::SurfaceSelector::Cylinder{cylinder->direction("axis"), cylinder->vector("through"),
                                                      cylinder->value("radius")};
  if (const auto plane = table.optional_table("plane"))
    surface.plane = fem::SurfaceSelector::Plane{plane->direction("normal"), plane->vector("through")};
  if (const auto box = table.optional_table("box"))
  {
    surface.box = fem::SurfaceSelector::Box{box->vector("min"), box->vector("max")};
    for (int i = 0; i < 3; ++i)
      if (surface.box->min[i] > surface.box->max[i])
        throw box->error("'min' is above 'max' in direction " + std::string(1, "xyz"[i]));
  }
  if (table.has("group"))
    surface.group = table.text("group");
  if (!surface.cylinder && !surface.plane && !surface.box && !surface.group)
    throw table.error("needs at least one of 'cylinder', 'plane', 'box', 'group' to select faces by");
  if (table.has("tolerance"))
    surface.tolerance = table.value("tolerance");
  surface.faces = table.is_text("faces") ? (table.choice("faces", {"any"}, "any"), 0) : table.integer("faces", 1);
  if (surface.faces < 1 && !table.is_text("faces"))
    throw table.error("faces", "needs the number of faces expected, 1 or more, or \"any\"");
  return surface;
}

/// Path of the frame or the part of [OWNER.support.NAME].
std::string owner_of(const SceneTable &table)
{
  const std::string path = table.path();
  return path.substr(0, path.rfind('.', path.rfind('.') - 1));
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
  std::set<std::string> visited;
  for (const auto &name : names)
  {
    if (!frame.surfaces.count(name))
      throw table.error(key, "there is no [" + owner_of(table) + ".surface." + written_key(name) + "]" +
                                 suggestion(name, declared));
    if (!visited.insert(name).second)
      throw table.error(key, "names '" + name + "' twice");
  }
  return names;
}

/// `key`, a total over the surface, or `key`_per_area.
fem::Vector3 total_or_per_area(const SceneTable &table, const std::string &key, const Kind &total, const Kind &per_area,
                               bool &is_per_area)
{
  const std::string longer = key + "_per_area";
  is_per_area              = table.has(longer);
  if (is_per_area && table.has(key))
    throw table.error(longer,
                      "cannot be given together with '" + key + "', the total over the surface; give one of them");
  return is_per_area ? read_per_direction(table, longer, per_area) : read_per_direction(table, key, total);
}

fem::Support read_support(const SceneTable &any, const fem::FrameSpecification &frame)
{
  const SceneTable table = any.declared(support_keys());
  check_thing_name(table);
  fem::Support support;
  support.name          = table.name();
  support.place         = table.place();
  support.surfaces      = read_surface_names(table, frame);
  const bool clamped    = table.truth("clamped");
  const auto foundation = table.optional_table("foundation");
  const bool directions = table.has("directions");
  if (clamped == foundation.has_value())
    throw table.error("needs either 'clamped = true' or 'foundation = { stiffness = ..., damping = ... }'");
  if (directions && !clamped)
    throw table.error("directions", "applies to a clamped support; a foundation needs stiffness = [x, y, z]");

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
    support.stiffness =
        total_or_per_area(*foundation, "stiffness", kind::stiffness, kind::bedding, support.per_area[0]);
    support.damping =
        total_or_per_area(*foundation, "damping", kind::damping, kind::damping_per_area, support.per_area[1]);
    if (support.stiffness == fem::Vector3{} && support.damping == fem::Vector3{})
      throw foundation->error("needs a stiffness such as \"420 kN/mm\", a damping, or both");
    if (foundation->has("axes"))
    {
      const Eigen::Matrix3d axes = read_axes(*foundation, "axes");
      for (int d = 0; d < 3; ++d)
        support.axes[d] = {axes(0, d), axes(1, d), axes(2, d)};
    }
  }
  return support;
}

void read_degree(const SceneTable &table, fem::InterfaceSpecification &interface)
{
  constexpr int largest = 8; // beyond it polynomials of neighbouring degrees differ by less than meshes resolve
  const int     degree  = table.whole("degree");
  if (interface.coupling == fem::InterfaceCoupling::flexible)
    interface.degree = degree;
  else if (table.has("degree"))
    throw table.error("degree", "applies to coupling = \"flexible\" only; remove it");
  if (degree < 1 || degree > largest)
    throw table.error("degree",
                      "got " + std::to_string(degree) + "; needs an integer from 1 to " + std::to_string(largest));
}

fem::InterfaceSpecification read_interface(const SceneTable &any, const fem::FrameSpecification &frame)
{
  const SceneTable table = any.declared(interface_keys());
  check_thing_name(table);
  auto interface   = table.filled<fem::InterfaceSpecification>();
  interface.name   = table.name();
  interface.place  = table.place();
  const bool point = interface.coupling == fem::InterfaceCoupling::point;
  const bool node  = interface.coupling == fem::InterfaceCoupling::node;
  if (!node || table.has("surface") || table.has("surfaces"))
    interface.surfaces = read_surface_names(table, frame);
  if (point || node)
    table.vector("position"); // required
  if (table.has("radius") && !point)
    throw table.error("radius", "applies to coupling = \"point\" only; other interfaces use their whole surfaces");
  if (point)
    interface.radius = table.value_or("radius", 0.);
  read_degree(table, interface);
  return interface;
}

fem::CutSpecification read_cut(const SceneTable &any)
{
  const SceneTable table = any.declared(cut_keys());
  check_thing_name(table);
  const auto            plane = table.table("plane");
  fem::CutSpecification cut{table.name(), plane.vector("through"), plane.direction("normal"), table.place()};
  if (table.has("first"))
    cut.first = table.direction("first");
  if (table.has("about"))
    cut.about = table.vector("about");
  return cut;
}

fem::StressPointSpecification read_stress_point(const SceneTable &any)
{
  const SceneTable table = any.declared(stress_point_keys());
  check_thing_name(table);
  fem::StressPointSpecification point;
  point.name  = table.name();
  point.place = table.place();
  point.at    = table.vector("at");
  if (table.has("along"))
    point.along = table.direction("along");
  return point;
}

/// '*' matches any letters, '?' one letter.
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
  auto mesh  = table.filled<fem::MeshOptions>();
  mesh.place = table.place();
  mesh.size  = is_mesh_file ? table.value_or("size", 0.) : table.value("size");
  if (mesh.layers < 1)
    throw table.error("layers", "needs the number of elements through a plate, 1 or more");
  if (table.has("layers") && mesh.plates != fem::Plates::swept)
    throw table.error("layers", "is the number of elements through swept plates; set plates = \"swept\", or remove it");
  if (mesh.curved && mesh.plates == fem::Plates::swept)
    throw table.error("curved", "is for tetrahedra, but swept elements have straight edges; remove it or 'plates'");
  if (mesh.bodies < 1)
    throw table.error("bodies", "needs the number of bodies expected, 1 or more");
  std::vector<std::string> own;
  for (const Key &key : mesh_keys())
    own.push_back(key.name);
  std::vector<std::string> known = own;
  for (const auto &entry : frame.surfaces)
    known.push_back(entry.first);
  for (const auto &key : table.keys())
  {
    if (std::find(own.begin(), own.end(), key) != own.end())
      continue;
    bool any = false;
    for (const auto &entry : frame.surfaces)
      if (matches(key, entry.first))
        mesh.surface_size[entry.first] = table.positive(key, kind::length), any = true;
    if (!any)
      throw table.error(key, "is neither " + listed(own) + " nor the name of a surface" + suggestion(key, known));
  }
  return mesh;
}

/// A surface moves with one interface only, and an interface cannot move where the frame is clamped.
void check_overlaps(const SceneTable &frame, const fem::FrameSpecification &specification)
{
  std::map<std::string, std::string> owner;
  for (const auto &interface : specification.interfaces)
    for (const auto &surface : interface.surfaces)
      if (interface.coupling == fem::InterfaceCoupling::point || interface.coupling == fem::InterfaceCoupling::node)
        continue; // takes but a few nodes; that these are its own is checked on the mesh
      else if (const auto [first, is_new] = owner.emplace(surface, "interface '" + interface.name + "'"); !is_new)
        throw std::invalid_argument(interface.place + ": surface '" + surface + "' is part of " + first->second +
                                    "; give each interface separate surfaces");
  for (const auto &mass : specification.masses)
    for (const auto &surface : mass.surfaces)
      if (const auto [first, is_new] = owner.emplace(surface, "mass '" + mass.name + "'"); !is_new)
        throw std::invalid_argument(mass.place + ": surface '" + surface + "' is part of " + first->second +
                                    "; put the mass on that interface, or give it separate surfaces");
  for (const auto &support : specification.supports)
    if (support.kind == fem::SupportKind::clamped)
      for (const auto &surface : support.surfaces)
        if (owner.count(surface))
          throw std::invalid_argument(support.place + ": surface '" + surface + "' is clamped, but is part of " +
                                      owner.at(surface) + ", which must be free to move");
  if (specification.interfaces.empty())
    throw frame.error("has no interface; declare at least one [" + frame.path() +
                      ".interface.NAME] for the mechanism or a joint to act on");
}

/// A motor or a counterweight, on an interface or on surfaces of its own.
fem::AttachedMass read_mass(const SceneTable &any, const fem::FrameSpecification &frame)
{
  const SceneTable table = any.declared(attached_mass_keys());
  check_thing_name(table);
  auto mass  = table.filled<fem::AttachedMass>();
  mass.name  = table.name();
  mass.place = table.place();
  if (table.has("inertia"))
    mass.inertia = read_tensor(table);
  const bool surfaces = table.has("surface") || table.has("surfaces");
  if (surfaces == table.has("on"))
    throw table.error("needs either 'on', the interface that carries it, or 'surfaces' for its attachment");
  if (surfaces)
  {
    mass.surfaces = read_surface_names(table, frame);
    return mass;
  }
  std::vector<std::string> known;
  for (const auto &interface : frame.interfaces)
    known.push_back(interface.name);
  const std::string on = table.text("on");
  mass.interface       = on.rfind("frame.", 0) == 0 ? on.substr(6) : on;
  if (std::find(known.begin(), known.end(), mass.interface) == known.end())
    throw table.error("on", "there is no [" + owner_of(table) + ".interface." + written_key(mass.interface) + "]" +
                                suggestion(mass.interface, known));
  return mass;
}

/// Largest distance of edges to be joined [m].
double read_sewing(const SceneTable &frame)
{
  if (!frame.has("repair"))
    return 0.;
  constexpr double usual = 5e-5; // CAD programs sew within 0.01 to 0.1 mm
  if (!frame.is_table("repair"))
    return frame.choice("repair", {"sew"}, "sew"), usual;
  return frame.table("repair").value("sew");
}

/// Number of parts, 0 for "auto".
int read_number_of_parts(const SceneTable &frame)
{
  constexpr int most = 64; // that are joined at once
  const bool    text = frame.is_text("parts"), automatic = text && frame.text("parts") == "auto";
  const int     number = automatic ? 0 : text ? -1 : frame.whole("parts");
  if (!automatic && (number < 1 || number > most))
    throw frame.error("parts", "needs a number from 1 to " + std::to_string(most) + ", or \"auto\"");
  return number;
}

} // namespace

fem::Prestress read_prestress(const SceneTable &table, const SceneTable &scene)
{
  fem::Prestress prestress;
  prestress.place  = table.place();
  prestress.factor = table.value("factor");
  if (table.truth("gravity"))
    prestress.acceleration = scene.vector_or("gravity", {});
  if (!std::isfinite(prestress.factor) || prestress.factor == 0.)
    throw table.error("factor", "needs a number other than zero; leave out 'prestress' for a frame without it");
  return prestress;
}

fem::Prestress read_surface_loads(const SceneTable &table, const SceneTable &scene,
                                  const fem::FrameSpecification &frame)
{
  fem::Prestress prestress = read_prestress(table, scene);
  for (const SceneTable &own : table.table_array("loads"))
  {
    if (!own.has("force") && !own.has("pressure"))
      throw own.error("needs a 'force' such as [0, 0, \"-500 kN\"], a 'pressure', or both");
    prestress.loads.push_back(
        {read_surface_names(own, frame), own.vector_or("force", {}), own.value_or("pressure", 0.), own.place()});
  }
  if (prestress.loads.empty() && prestress.acceleration == fem::Vector3{})
    throw table.error("has no load; give it 'loads', or gravity = true and the scene a 'gravity'");
  return prestress;
}

fem::FrameSpecification read_frame_geometry(const SceneTable &frame, const SceneTable &scene)
{
  fem::FrameSpecification specification;
  specification.place = frame.place();
  specification.cad   = frame.file("cad");

  auto ending = std::filesystem::path(specification.cad).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  const std::vector<std::string> endings{".step", ".stp", ".brep", ".geo", ".msh", ".inp"};
  if (std::find(endings.begin(), endings.end(), ending) == endings.end())
    throw frame.error("cad", "a file ending in '" + ending + "' cannot be read; valid: " + listed(endings));
  specification.unit = frame.value_or("unit", 0.);
  specification.sew  = read_sewing(frame);
  if (frame.has("parts"))
    specification.parts = read_number_of_parts(frame);
  specification.cad       = with_dimensions(frame, specification.cad, specification.unit);
  specification.material  = read_material(frame, scene);
  specification.materials = read_solid_materials(frame, scene);
  if (const auto table = frame.optional_table("damping"))
  {
    const FrameDamping damping        = read_damping(*table);
    specification.modal_damping_ratio = damping.ratios;
    specification.rayleigh_mass       = damping.alpha;
    specification.rayleigh_stiffness  = damping.beta;
  }

  for (const auto &table : frame.tables("surface"))
    specification.surfaces[table.name()] = read_surface(table);
  for (const auto &table : frame.tables("support"))
    specification.supports.push_back(read_support(table, specification));
  for (const auto &table : frame.tables("interface"))
    specification.interfaces.push_back(read_interface(table, specification));
  for (const auto &table : frame.tables("mass"))
    specification.masses.push_back(read_mass(table, specification));
  for (const auto &table : frame.tables("cut"))
    specification.cuts.push_back(read_cut(table));
  for (const auto &table : frame.tables("stress_point"))
    specification.stress_points.push_back(read_stress_point(table));
  check_overlaps(frame, specification);
  const bool is_mesh = ending == ".msh" || ending == ".inp";
  specification.mesh =
      is_mesh && !frame.has("mesh") ? fem::MeshOptions{} : read_mesh(frame.table("mesh"), specification, is_mesh);
  return specification;
}

} // namespace gestell::apps
