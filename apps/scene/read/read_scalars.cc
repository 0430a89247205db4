#include "apps/scene/read/read_scalars.h"

#include "apps/scene/read/read_function.h"
#include "fem/values/nearest_name.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <map>

namespace gestell::apps
{
namespace
{

using coupling::BodyKind;

constexpr const char *motions[] = {"ux", "uy", "uz", "rx", "ry", "rz"};

struct NamedScalar
{
  std::string name, unit;
  MotionTerm  term;
};

/// All coordinates that a scalar may be, by name.
std::vector<NamedScalar> coordinates(const Names &names)
{
  std::vector<NamedScalar> all;
  const auto add = [&](const std::string &name, bool rotation, const std::string &marker, const Vector3 &axis) {
    all.push_back({name, rotation ? "rad" : "m", {marker, rotation, axis, 1.}});
  };
  for (const std::string &name : names.body_names())
  {
    const BodyRequest &body = *names.find_body(name);
    if (body.kind == BodyKind::rotor || body.kind == BodyKind::planar)
      add(name + ".angle", true, name, body.axis);
    if (body.kind == BodyKind::slider)
      add(name + ".displacement", false, name, body.axis);
    if (body.kind == BodyKind::rotor || body.kind == BodyKind::slider)
      add(name, body.kind == BodyKind::rotor, name, body.axis);
    if (body.kind != BodyKind::rotor && body.kind != BodyKind::slider)
      for (int d = 0; d < 3; ++d)
      {
        Vector3 axis{};
        axis[d] = 1.;
        add(name + "." + motions[d], false, name, axis);
      }
  }
  for (const std::string &interface : names.interfaces())
    for (int i = 0; i < 6; ++i)
    {
      Vector3 axis{};
      axis[i % 3] = 1.;
      add("frame." + interface + "." + motions[i], i > 2, "frame." + interface, axis);
    }
  return all;
}

} // namespace

ScalarRequest read_scalar(const SceneTable &table, const std::string &key, const Names &names)
{
  const std::string name = table.text(key);
  if (const MeasureRequest *measure = names.find_measure(name))
  {
    if (measure->function || measure->terms.size() > 1)
      throw table.error(key, "the measure '" + name + "' is itself a sum of measures; name its terms");
    if (!measure->terms.empty())
      return {measure->terms[0], measure->unit, name};
    return {{1., {}, std::make_shared<MeasureRequest>(*measure)}, measure->unit, name};
  }
  const std::string        own = names.coordinate(name);
  std::vector<std::string> valid;
  for (const NamedScalar &known : coordinates(names))
  {
    if (known.name == own)
      return {{1., {known.term}, nullptr}, known.unit, name};
    valid.push_back(known.name);
  }
  const BodyRequest *body = names.find_body(name);
  throw table.error(key, body ? "'" + name + "' has several coordinates; name one, as '" + name + ".ux', or a [measure]"
                              : "there is no measure or coordinate '" + name + "'" + suggestion(name, valid));
}

/// Refuses angles that jump by a full turn in sums and in functions that are not periodic.
static void refuse_wrapping(const SceneTable &table, const std::string &key, const ScalarRequest &scalar)
{
  using Form = mechanism::RelativeMeasure::Form;
  if (scalar.term.placed && (scalar.term.placed->form == Form::angle || scalar.term.placed->form == Form::inclination))
    throw table.error(key, "the angle '" + scalar.name +
                               "' wraps at +-180 degrees, so functions of it would jump; use the angle of a rotor or "
                               "planar body, or, as `from`, a function with a `period` and no `rise`");
}

MeasureRequest read_position_function(const SceneTable &table, const Names &names, ScalarRequest &x)
{
  x            = read_scalar(table, "from", names);
  const auto y = read_scalar(table, "to", names);
  if (table.text("from") == table.text("to"))
    throw table.error("to",
                      "is '" + y.name + "', the same as `from`; a position function needs two different coordinates");
  if (x.term.weight != 1.)
    throw table.error("from",
                      "'" + x.name +
                          "' is a multiple of another coordinate; name that one, and put the factor into the function");
  if (!table.has("period") || table.has("rise"))
    refuse_wrapping(table, "from", x);
  refuse_wrapping(table, "to", y);
  const bool     turns = x.unit == "rad";
  const Variable variable{"x", turns ? "angle" : "displacement", x.kind().dimension,
                          turns ? Counts::radians : Counts::nothing};
  MeasureRequest measure;
  measure.unit     = y.unit;
  measure.terms    = {y.term};
  measure.argument = x.term;
  measure.function = read_function(table, variable, x.kind(), y.kind());
  return measure;
}

/// Whether all terms cancel: for each marker the sum of weight * axis, for a measure of two points its weight.
static bool cancel(const std::vector<TermRequest> &terms)
{
  constexpr double                                        rounding = 1e-14; // of factors that are written by decimals
  std::map<std::pair<std::string, bool>, Eigen::Vector3d> motions;
  std::map<std::string, double>                           scalars;
  double                                                  whole = 0.;
  for (const TermRequest &term : terms)
  {
    whole += std::abs(term.weight);
    if (term.placed)
      scalars[term.placed->name] += term.weight;
    for (const MotionTerm &motion : term.motion)
      motions.try_emplace({motion.marker, motion.rotation}, Eigen::Vector3d::Zero()).first->second +=
          term.weight * motion.weight * Eigen::Map<const Eigen::Vector3d>(motion.axis.data());
  }
  return std::all_of(motions.begin(), motions.end(),
                     [&](const auto &motion) { return motion.second.norm() <= rounding * whole; }) &&
         std::all_of(scalars.begin(), scalars.end(),
                     [&](const auto &scalar) { return std::abs(scalar.second) <= rounding * whole; });
}

MeasureRequest read_sum(const SceneTable &table, const Names &names)
{
  struct Part
  {
    SceneTable    table;
    ScalarRequest y;
    Quantity      factor; ///< a plain number gets the unit that makes its term fit
  };
  std::vector<Part> parts;
  MeasureRequest    measure;
  const auto        join = [&](const Part &part, const Dimension &sum)
  {
    const std::string unit = equal(sum, kind::length.dimension) ? "m" : equal(sum, kind::angle.dimension) ? "rad" : "";
    if (unit.empty() || (!measure.unit.empty() && unit != measure.unit))
      throw part.table.error("factor",
                             "gives a term of " + describe(sum) + "; all terms must be lengths, or all angles");
    measure.unit = unit;
  };
  for (const auto &part : table.table_array("terms"))
  {
    parts.push_back(
        {part, read_scalar(part, "of", names), part.has("factor") ? part.quantity("factor") : Quantity{1., {}, true}});
    refuse_wrapping(part, "of", parts.back().y);
    if (!parts.back().factor.checked)
      continue;
    Dimension sum = parts.back().y.kind().dimension;
    for (std::size_t i = 0; i < sum.size(); ++i)
      sum[i] += parts.back().factor.dimension[i];
    join(parts.back(), sum);
  }
  for (const Part &part : parts)
  {
    if (measure.unit.empty()) // factors are plain numbers all over
      for (const Part &other : parts)
        if (other.y.unit != part.y.unit)
          throw part.table.error("factor", "has no unit, like all factors here, but the terms are lengths and angles; "
                                           "give one factor a unit, which defines the unit of the sum");
    if (measure.unit.empty())
      join(part, part.y.kind().dimension);
    measure.terms.push_back(part.y.term);
    measure.terms.back().weight *= part.factor.value;
  }
  if (measure.terms.empty())
    throw table.error("needs 'terms' such as [{ of = \"rack\" }, { of = \"pinion\", factor = \"-40 mm\" }]");
  if (cancel(measure.terms))
    throw table.error("terms", "cancel each other: the sum is always zero; check the terms and their factors");
  return measure;
}

} // namespace gestell::apps
