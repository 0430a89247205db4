#include "apps/scene/read/read_material.h"

#include "fem/values/number_text.h"

#include <cmath>
#include <map>
#include <sstream>

namespace gestell::apps
{
namespace
{

/// The range of values of solids, and the other units in which a number outside this range is probably given.
struct Plausible
{
  const char *unit;
  double      least, most; ///< outside: no solid
  double      low, high;   ///< outside: hardly any structure
  const char *below, *above;
  struct OtherUnit
  {
    const char *name;
    double      factor;
  };
  std::vector<OtherUnit> others;
};

const Plausible &plausible_density()
{
  static const Plausible density{"kg/m^3",
                                 1.,
                                 30000.,
                                 50.,
                                 23000.,
                                 "lighter than any solid",
                                 "heavier than any solid",
                                 {{"t/mm^3", 1e12}, {"kg/mm^3", 1e9}, {"g/cm^3", 1e3}}};
  return density;
}

const Plausible &plausible_modulus()
{
  static const Plausible modulus{
      "Pa", 1e6, 2e12, 1e8, 1.2e12, "softer than rubber", "stiffer than diamond", {{"GPa", 1e9}, {"MPa", 1e6}}};
  return modulus;
}

/// Hint at the unit in which the number would be the value of a common structural material.
std::string likely_unit(const Plausible &range, double value, double common_low, double common_high)
{
  for (const auto &[name, factor] : range.others)
    if (factor * value >= common_low && factor * value <= common_high)
    {
      std::ostringstream text;
      text << "; if " << value << " " << name << " was meant, write it with its unit or as " << factor * value << " "
           << range.unit;
      return text.str();
    }
  return {};
}

/// Description of an implausible value; empty for a plausible one.
std::string suspicion(const Plausible &range, double value, double common_low, double common_high)
{
  if (value >= range.low && value <= range.high)
    return {};
  std::ostringstream text;
  text << "is " << value << " " << range.unit << ", " << (value < range.low ? range.below : range.above)
       << likely_unit(range, value, common_low, common_high);
  return text.str();
}

/// Refuses a plain number that no solid has, or that is rare but common in another unit: the unit is probably wrong. A
/// number with a unit only causes a warning.
/// @return whether the value is plausible
bool check_plausible(const SceneTable &table, const std::string &key, const Plausible &range, double value,
                     double common_low, double common_high)
{
  const std::string text = suspicion(range, value, common_low, common_high);
  if (text.empty())
    return true;
  const bool mistaken =
      value < range.least || value > range.most || !likely_unit(range, value, common_low, common_high).empty();
  if (mistaken && !table.is_text(key))
    throw table.error(key, text + "; numbers without unit are SI");
  table.warn(key, text + "; expected: " + short_text(range.low) + " to " + short_text(range.high) + ' ' + range.unit);
  return false;
}

constexpr double lightest_common = 400., heaviest_common = 20000.; ///< [kg/m^3] foam is lighter, tungsten has 19300

/// Waves in solids that frames are made of run at 2500 m/s (weak concrete) to 13000 m/s (beryllium, ceramics); slower
/// ones are plastics, lighter than 2000 kg/m^3, and heavy soft metals as lead.
void check_speed_of_waves(const SceneTable &table, const fem::Material &material)
{
  // [m/s] lead 1200 and plastics are light or heavy; silicon carbide has 12000
  constexpr double slowest = 2300., fastest = 14000., light = 2000., heavy = 10000.;
  const double     speed = std::sqrt(material.E / material.rho);
  if (speed > fastest || (speed < slowest && material.rho > light && material.rho < heavy))
    table.warn("E", "gives, with rho = " + short_text(material.rho) + " kg/m^3, a wave speed sqrt(E/rho) of " +
                        short_text(speed) + " m/s; expected: " + short_text(slowest) + " to " + short_text(fastest) +
                        " m/s (steel, aluminium 5100); check the units of E and rho");
}

fem::Material material_from(const SceneTable &any)
{
  const SceneTable table    = any.declared(material_keys());
  auto             material = table.filled<fem::Material>();
  material.place            = table.place();
  if (material.nu <= -1. || material.nu >= 0.5)
    throw table.error("nu", "Poisson's ratio must be above -1 and below 0.5; steel has 0.3");
  const bool E_plausible = check_plausible(table, "E", plausible_modulus(), material.E, 5e9, 5e11);
  if (table.has("rho") &&
      check_plausible(table, "rho", plausible_density(), material.rho, lightest_common, heaviest_common) && E_plausible)
    check_speed_of_waves(table, material); // a second warning of one mistake otherwise
  return material;
}

std::map<std::string, fem::Material> known_materials(const SceneTable &scene)
{
  // Handbook values at room temperature; own materials may redefine them.
  std::map<std::string, fem::Material> known = {{"steel", {210e9, 0.3, 7850., ""}},
                                                {"cast iron", {110e9, 0.26, 7200., ""}},
                                                {"aluminium", {70e9, 0.33, 2700., ""}}};
  for (const auto &own : scene.tables("material"))
    known[own.name()] = material_from(own);
  for (auto &[name, material] : known)
    material.name = name;
  return known;
}

} // namespace

const std::vector<Key> &material_keys()
{
  static const std::vector<Key> keys = {
      key::number("E", kind::pressure, "Young's modulus").above_zero().into(&fem::Material::E),
      key::number("nu", kind::number, "Poisson's ratio, above -1 and below 0.5").into(&fem::Material::nu),
      key::number("rho", kind::density, "density; a STEP file may contain it, which a line of the run then reports")
          .above_zero()
          .into(&fem::Material::rho)
          .by_default("for a frame that of its STEP file")};
  return keys;
}

Key material_key()
{
  return key::named(
             "material",
             "`\"steel\"` (E 210 GPa, nu 0.3, rho 7850 kg/m³), `\"cast iron\"` (110 GPa, 0.26, 7200), `\"aluminium\"` "
             "(70 GPa, 0.33, 2700), the NAME of a `[material.NAME]`, or a table `{ E, nu, rho }`")
      .also({Key::Form::table});
}

fem::Material read_material(const SceneTable &table, const SceneTable &scene, const std::string &key,
                            const std::string &fallback)
{
  const auto known = known_materials(scene);
  if (table.is_table(key))
  {
    fem::Material material = material_from(table.table(key));
    material.name          = "own";
    return material;
  }
  std::vector<std::string> names;
  for (const auto &entry : known)
    names.push_back(entry.first);
  fem::Material material = known.at(table.choice(key, names, fallback));
  material.place         = table.place(key);
  return material;
}

fem::Material read_weighed_material(const SceneTable &table, const SceneTable &scene)
{
  fem::Material material = read_material(table, scene);
  if (material.rho == 0.)
    throw table.error("material", "has no density; give rho, such as \"7850 kg/m^3\"");
  return material;
}

double read_plausible_density(const SceneTable &table)
{
  const double density = table.value("density");
  check_plausible(table, "density", plausible_density(), density, lightest_common, heaviest_common);
  return density;
}

std::string suspect_density(double density)
{
  return suspicion(plausible_density(), density, lightest_common, heaviest_common);
}

void warn_of_density(const SceneTable &table, double mass, double volume)
{
  const std::string text = suspicion(plausible_density(), mass / volume, 0., 0.);
  if (text.empty())
    return;
  std::ostringstream whole;
  whole << "spread evenly over the " << volume << " m^3 of its shape, its density " << text
        << ": is the mass in kg, and the unit of its `cad` right?";
  table.warn("mass", whole.str());
}

std::vector<std::pair<std::string, fem::Material>> read_solid_materials(const SceneTable &frame,
                                                                        const SceneTable &scene)
{
  std::vector<std::pair<std::string, fem::Material>> materials;
  if (const auto table = frame.optional_table("materials"))
    for (const std::string &solid : table->keys())
      materials.emplace_back(solid, read_material(*table, scene, solid, ""));
  return materials;
}

} // namespace gestell::apps
