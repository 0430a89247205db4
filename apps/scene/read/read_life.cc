#include "apps/scene/read/read_life.h"

#include "apps/scene/read/read_output.h"
#include "fem/values/nearest_name.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>

namespace gestell::apps
{

const std::vector<Key> &curve_keys()
{
  static const std::vector<Key> keys = {
      key::number("class", kind::number, "notch class of `standard`: its range in MPa at 2 million cycles, `71`")
          .above_zero()
          .by_default("`table` or `strength`")
          .into(&CurveRequest::notch_class),
      key::choice("standard", {"EN 1993-1-9", "EN 13001-3-1"}, true, "standard that defines `class`"),
      key::number("slope", kind::number,
                  "slope of a class of EN 13001-3-1: 3 for welds, 5 for unwelded material and for shear")
          .above_zero()
          .by_default("3; shear: 5")
          .into(&CurveRequest::slope),
      key::composed(
          "table", Key::Form::rows, kind::pressure, {},
          "rows of cycles and stress range, interpolated in logarithms; ranges below the last one cause no damage")
          .by_default("`class` or `strength`"),
      key::number("strength", kind::pressure,
                  "tensile strength R_m; without `class` and `table` it defines the FKM curve of unwelded material; "
                  "also used by `mean_stress`")
          .above_zero()
          .by_default("none")
          .into(&CurveRequest::strength),
      key::plain("material", Key::Form::text, "FKM material group: `\"steel\"`, `\"cast steel\"`, ...")
          .by_default("steel"),
      key::number("design_factor", kind::number, "FKM design factor K: roughness, size, surface treatment")
          .above_zero()
          .by_default(&CurveRequest::design_factor),
      key::number("ratio", kind::number, "stress ratio R of the cycles of `table`, used by `mean_stress`")
          .by_default("any")
          .into(&CurveRequest::ratio),
      key::number("safety", kind::number, "partial factor, which divides the ranges of the curve")
          .above_zero()
          .by_default(&CurveRequest::safety),
      key::number("damage_sum", kind::number,
                  "damage sum at failure, FKM: 0.3 for unwelded steel, cast steel and aluminium, 0.5 for welds, 1 for "
                  "cast iron. Reported damages are relative to it")
          .above_zero()
          .by_default(&CurveRequest::damage_sum),
      key::truth("stress_relieved", false,
                 "whether the compressive part of a range counts only 60 %, as EN 1993-1-9 (7.2.1) allows for unwelded "
                 "and stress-relieved details")
          .into(&CurveRequest::stress_relieved)};
  return keys;
}

const std::vector<Key> &weld_keys()
{
  static const std::vector<Key> keys = {
      key::plain("name", Key::Form::text, "name of the weld, for results")
          .by_default("of its surfaces and of a shear stress"),
      key::plain("surfaces", Key::Form::texts,
                 "names of `[frame.surface.NAME]` with a plane, cylinder or box: one surface is an area, two are a "
                 "line where they meet; stresses are evaluated on the first"),
      key::direction("direction", "direction across the weld")
          .by_default("in the first surface, away from the second; none for an area, see `measure`"),
      key::choice("stress", {"normal", "shear"}, true, "stress across the weld, or shear along it"),
      key::table("curve", curve_keys(), "its S-N curve").by_default("that of `[life]`"),
      key::number("thickness", kind::length, "thickness t of the plate, for extrapolation to the hot spot of a line")
          .above_zero()
          .by_default("no extrapolation")
          .into(&WeldRequest::thickness),
      key::composed("distances", Key::Form::numbers, kind::number, {},
                    "distances of the extrapolation points from the line, in t: two (linear) or three (quadratic)")
          .by_default("[0.4, 1]")};
  return keys;
}

const std::vector<Key> &block_keys()
{
  static const std::vector<Key> keys = {
      key::plain("scene", Key::Form::file, "scene of this load, with the same frame"),
      key::number("repetitions", kind::number, "number of repetitions of its run in the load spectrum, at least 1")
          .by_default(&BlockRequest::repetitions)};
  return keys;
}

const std::vector<Key> &life_keys()
{
  static const std::vector<Key> keys = {
      key::table("curve", curve_keys(), "S-N curve of the skin, `{ class = 71 }`")
          .by_default("none: only welds are assessed"),
      key::choice("measure", {"critical plane", "signed von mises"}, true,
                  "stress for counting if no direction is given: normal stress on the plane of largest damage, or von "
                  "Mises stress with the sign of the mean normal stress"),
      key::choice("mean_stress", {"none", "goodman", "fkm"}, true,
                  "mean stress correction; `\"goodman\"` and `\"fkm\"` need `strength`"),
      key::choice("miner", {"original", "elementary", "consequent"}, true,
                  "ranges below the knee: no damage (original), damage by the extended slope (elementary), or a limit "
                  "that falls as damage grows (consequent). Weld classes have their own second slope and cut-off"),
      key::choice("residue", {"repeated", "half"}, true,
                  "ranges that form no closed cycle: closed by the next repetition of the load, or counted as half "
                  "cycles (ASTM E1049)"),
      key::number("repetitions", kind::number, "number of repetitions of this run in the load spectrum, at least 1")
          .by_default(&LifeRequest::repetitions),
      key::number("strokes", kind::number, "number of strokes that one run represents")
          .above_zero()
          .by_default(&LifeRequest::strokes),
      key::number("period", kind::time, "time in service that one run represents")
          .above_zero()
          .by_default("its duration from `output.from`")
          .into(&LifeRequest::period),
      key::number("step", kind::time, "interval of the states used for counting")
          .above_zero()
          .by_default("the fixed step; with a tolerance 1/20000 of the run")
          .into(&LifeRequest::step),
      key::composed("weld", Key::Form::tables, kind::number, weld_keys(), "`[[life.weld]]`").by_default("none"),
      key::composed("block", Key::Form::tables, kind::number, block_keys(),
                    "`[[life.block]]`: further runs of the load spectrum, in order")
          .by_default("none")};
  return keys;
}

namespace
{

CurveRequest read_curve(const SceneTable &table)
{
  CurveRequest curve;
  table.fill(curve);
  curve.place    = table.place();
  curve.standard = table.choice("standard");
  curve.material = table.text("material", "steel");
  if (table.has("table"))
    curve.points = table.pairs("table", kind::number, kind::pressure);
  if (curve.notch_class && table.has("table"))
    throw table.error("table", "cannot be given together with 'class', which is a curve, too; give one of them");
  if (table.has("table") && curve.points.size() < 2)
    throw table.error("table", "needs two rows or more, [[1e4, \"300 MPa\"], [2e6, \"71 MPa\"]]");
  for (std::size_t i = 1; i < curve.points.size(); ++i)
    if (const auto &a = curve.points[i - 1], &b = curve.points[i];
        !(a[0] > 0. && b[0] > a[0] && b[1] < a[1] && b[1] > 0.))
      throw table.error("table", "must fall: row " + std::to_string(i + 1) + " has " + short_text(1e-6 * b[1]) +
                                     " MPa at " + short_text(b[0]) + " cycles after " + short_text(1e-6 * a[1]) +
                                     " MPa at " + short_text(a[0]) +
                                     "; order the rows by cycles, with ranges that become smaller");
  if (!curve.notch_class && curve.points.empty() && !curve.strength)
    throw table.error("needs 'class', 'table' or 'strength'");
  constexpr double least_strength = 1e6; // [Pa]: of no metal; a number without a unit is in Pa
  const auto       require_metal  = [&](const std::string &key, double stress)
  {
    if (stress < least_strength)
      throw table.error(key,
                        "is " + short_text(stress) + " Pa; write the unit, such as \"" + short_text(stress) + " MPa\"");
  };
  if (curve.strength)
    require_metal("strength", *curve.strength);
  if (!curve.points.empty())
    require_metal("table", curve.points.front()[1]);
  if (table.has("design_factor") && (curve.notch_class || !curve.points.empty()))
    throw table.error("design_factor", "belongs to the FKM curve of 'strength'; remove it");
  if (curve.slope && !(curve.notch_class && curve.standard == "EN 13001-3-1"))
    throw table.error("slope", "belongs to a 'class' of standard = \"EN 13001-3-1\"; remove it");
  if (curve.stress_relieved && !(curve.notch_class && curve.standard == "EN 1993-1-9"))
    throw table.error("stress_relieved", "belongs to a 'class' of standard = \"EN 1993-1-9\"; remove it");
  return curve;
}

void require_count(const SceneTable &table, double repetitions)
{
  constexpr double most = 9e15; // counts above are rounded
  if (!(repetitions >= 1. && repetitions <= most))
    throw table.error("repetitions",
                      "needs a number of 1 or more, at most " + short_text(most) + ", got " + short_text(repetitions));
}

WeldRequest read_weld(const SceneTable &table, const fem::FrameSpecification &frame)
{
  WeldRequest weld;
  table.fill(weld);
  weld.place    = table.place();
  weld.surfaces = table.texts("surfaces");
  if (weld.surfaces.empty() || weld.surfaces.size() > 2)
    throw table.error("surfaces", "needs one surface or two, got " + std::to_string(weld.surfaces.size()));
  if (weld.surfaces.size() == 2 && weld.surfaces[0] == weld.surfaces[1])
    throw table.error("surfaces", "names '" + weld.surfaces[0] + "' twice; name two surfaces that meet, or one");
  weld.shear = table.choice("stress") == "shear";
  weld.name  = table.text("name", weld.surfaces.front() + (weld.surfaces.size() == 2 ? " to " + weld.surfaces[1] : "") +
                                      (weld.shear ? ", shear" : ""));
  std::vector<std::string> declared;
  for (const auto &entry : frame.surfaces)
    declared.push_back(entry.first);
  for (const std::string &name : weld.surfaces)
  {
    const auto own = frame.surfaces.find(name);
    if (own == frame.surfaces.end())
      throw table.error("surfaces", "there is no [frame.surface." + name + "]" + suggestion(name, declared));
    if (!own->second.plane && !own->second.cylinder && !own->second.box)
      throw table.error("surfaces", "'" + name + "' is selected by a group; a weld needs a plane, a cylinder or a box");
  }
  for (const fem::InterfaceSpecification &interface : frame.interfaces)
    if (interface.coupling == fem::InterfaceCoupling::rigid &&
        std::count(interface.surfaces.begin(), interface.surfaces.end(), weld.surfaces.front()) > 0)
      throw table.error("surfaces", "'" + weld.surfaces.front() + "' is rigid because of [frame.interface." +
                                        interface.name +
                                        "], so it has no stresses; name another surface first, or use "
                                        "coupling = \"average\" there");
  if (table.has("direction"))
    weld.direction = table.direction("direction");
  if (const auto curve = table.optional_table("curve"))
    weld.curve = read_curve(*curve);
  weld.distances = table.has("distances") ? table.numbers("distances", kind::number) : std::vector<double>{0.4, 1.};
  if (weld.shear && weld.surfaces.size() == 1 && !weld.direction)
    throw table.error("stress", "\"shear\" needs the 'direction' across the weld");
  if (weld.thickness > 0. && weld.surfaces.size() != 2)
    throw table.error("thickness", "belongs to a line; name the two surfaces that meet there");
  if (table.has("distances") && weld.thickness == 0.)
    throw table.error("distances", "are multiples of the thickness; give 'thickness'");
  if (weld.distances.size() < 2 || weld.distances.size() > 3 || !(weld.distances.front() > 0.) ||
      !std::is_sorted(weld.distances.begin(), weld.distances.end(), std::less_equal<>()))
    throw table.error("distances", "needs two or three numbers above 0 that rise, such as [0.4, 1] or [0.4, 0.9, 1.4]");
  return weld;
}

} // namespace

void read_life(const SceneTable &scene, Scene &result)
{
  if (!scene.has("life"))
    return;
  const SceneTable table = scene.table("life").declared(life_keys());
  request_stresses(table, result);
  LifeRequest life;
  table.fill(life);
  life.place       = table.place();
  life.mean_stress = table.choice("mean_stress");
  life.miner       = table.choice("miner");
  life.measure     = table.choice("measure");
  life.residue     = table.choice("residue");
  require_count(table, life.repetitions);
  if (const auto curve = table.optional_table("curve"))
    life.curve = read_curve(*curve);
  for (const SceneTable &own : table.table_array("weld"))
  {
    if (result.frame.source != FrameSource::geometry)
      throw own.error(
          "needs a frame of one piece from 'cad', in which its surfaces are; remove the weld, or [frame.part]");
    WeldRequest weld = read_weld(own, result.frame.geometry);
    if (weld.name == skin_name || std::any_of(life.welds.begin(), life.welds.end(),
                                              [&](const WeldRequest &other) { return other.name == weld.name; }))
      throw own.error("has the name '" + weld.name + "' of another place; give it a 'name' of its own");
    life.welds.push_back(std::move(weld));
  }
  for (const SceneTable &block : table.table_array("block"))
  {
    life.blocks.push_back(block.filled<BlockRequest>());
    life.blocks.back().file  = block.file("scene");
    life.blocks.back().place = block.place();
    require_count(block, life.blocks.back().repetitions);
  }
  const auto ignores_mean = [](const CurveRequest &curve)
  { return curve.notch_class || (!curve.points.empty() && !curve.ratio); };
  if (life.mean_stress != "none" && (life.curve.place.empty() || ignores_mean(life.curve)) &&
      std::all_of(life.welds.begin(), life.welds.end(),
                  [&](const WeldRequest &weld) { return !weld.curve || ignores_mean(*weld.curve); }))
    throw table.error("mean_stress", "has no effect on notch classes and on tables without 'ratio'; remove it");
  if (life.curve.place.empty())
    for (const WeldRequest &weld : life.welds)
      if (!weld.curve)
        throw table.error("needs 'curve', such as { class = 71 }: the weld '" + weld.name + "' has none");
  if (life.curve.place.empty() && life.welds.empty())
    throw table.error("needs 'curve', such as { class = 71 }, or a [[life.weld]] with a curve");
  coupling::RunOptions &run    = result.run.options;
  constexpr double      counts = 20000.; // per run, by default: the interval of the finest pictures of its swings
  if (life.step == 0. && result.run.given)
    life.step = run.method.step > 0. && run.method.tolerance == 0. ? run.method.step : (run.end - run.begin) / counts;
  run.states.step = run.states.step > 0. ? std::min(run.states.step, life.step) : life.step;
  result.life     = std::make_shared<const LifeRequest>(std::move(life));
}

} // namespace gestell::apps
