#include "apps/scene/read/read_scalars.h"

#include "apps/scene/read/read_profile.h"
#include "apps/scene/read/relative_motion.h"
#include "fem/values/nearest_name.h"
#include "mechanism/functions/slope_jump.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace gestell::apps
{
namespace
{

using coupling::BodyKind;
using mechanism::PositionFunction;

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

constexpr double seen_overshoot = 0.05; // of a spline beyond its rows, by the steps between rows beside it

/**
 * A spline through rows that rise after a level stretch, or have a wrong value among them, swings beyond them.  It may
 * do so only at an extreme, where the steps between rows change their sign.
 */
void warn_of_overshoot(const SceneTable &table, const std::vector<mechanism::CubicSpline::Point> &points, bool periodic,
                       const mechanism::CubicSpline &spline)
{
  const int  n    = int(points.size()) - 1;
  const auto step = [&](int i)
  {
    const int k = periodic ? (i + n) % n : std::clamp(i, 0, n - 1);
    return points[k + 1].f - points[k].f;
  };
  const auto   by_f  = [](const auto &a, const auto &b) { return a.f < b.f; };
  const auto   ends  = std::minmax_element(points.begin(), points.end(), by_f);
  const double whole = ends.second->f - ends.first->f; // of what rows range over: beside a level stretch
  double       worst = 0., at = 0., by = 0.;
  for (int i = 0; i < n; ++i)
  {
    const double steps[]  = {step(i - 1), step(i), step(i + 1)};
    const auto [down, up] = std::minmax_element(std::begin(steps), std::end(steps));
    const double largest = std::max(std::abs(*down), std::abs(*up)), scale = largest > 0. ? largest : whole;
    if ((*down < 0. && *up > 0.) || scale == 0.)
      continue;
    constexpr int n_between = 16;
    const auto [low, high]  = std::minmax(points[i].f, points[i + 1].f);
    for (int k = 1; k < n_between; ++k)
    {
      const double x = points[i].x + k * (points[i + 1].x - points[i].x) / n_between, f = spline.at(x).value;
      const double beyond = std::max(low - f, f - high);
      if (beyond > worst * scale)
        worst = beyond / scale, at = x, by = beyond;
    }
  }
  if (worst <= seen_overshoot)
    return;
  std::ostringstream text;
  text.precision(3);
  text << "the spline swings " << by << " beyond the rows on both sides of it at " << at << ", by " << 100. * worst
       << " % of the steps between rows there (of a level stretch, of what all rows range over); give more rows where "
          "the course bends, or round it";
  table.warn("table", text.str());
}

/// Speed that is constant until a switch brakes it, or a profile.
std::shared_ptr<const mechanism::MotionLaw> read_speed(const SceneTable &table, bool turns)
{
  using mechanism::BrakedMotion;
  const ProfileKeys keys  = turns ? speed_profile() : path_profile();
  const auto        brake = table.optional_table("brake");
  if (table.is_array("speed") || !brake)
  {
    const double from =
        table.is_array("speed") || table.has("waits") ? table.number("initial_speed", keys.level, 0.) : 0.;
    const auto speed = read_course(table, "speed", keys, from);
    return checked(table, [&] { return std::make_shared<mechanism::ProfileMotion>(speed); });
  }
  BrakedMotion::Parameters motion;
  motion.speed             = table.number("speed", keys.level);
  const std::string family = brake->choice("family", {"linear", "cosine", "shaped"}, "linear");
  motion.family            = family == "linear"   ? BrakedMotion::Family::linear
                             : family == "cosine" ? BrakedMotion::Family::cosine
                                                  : BrakedMotion::Family::shaped;
  motion.duration          = brake->positive("duration", kind::time);
  if (family == "shaped")
    for (const auto &ramp : brake->table_array("ramps"))
      motion.ramps.push_back({ramp.number("share", kind::number), ramp.not_negative("delay", kind::time, 0.)});
  return checked(*brake, [&] { return std::make_shared<BrakedMotion>(motion); });
}

} // namespace

std::shared_ptr<const PositionFunction> read_function(const SceneTable &table, const Variable &variable, const Kind &x,
                                                      const Kind &y)
{
  const bool formula = table.has("function");
  if (formula == table.has("table"))
    throw table.error("needs 'function', a formula of " + variable.name +
                      ", or 'table', rows of two values; one of both");
  std::optional<PositionFunction::Period> period;
  if (table.has("period"))
  {
    period.emplace();
    period->length = table.positive("period", x);
    period->rise   = table.number("rise", y, 0.);
    if (formula)
      period->begin = table.number("begin", x, 0.);
  }
  if (formula)
  {
    const auto f = table.formula("function", {variable}, y);
    return checked(table, [&] { return std::make_shared<PositionFunction>(f, period); });
  }
  using mechanism::CubicSpline;
  std::vector<CubicSpline::Point> points;
  for (const auto &row : table.pairs("table", x, y))
    points.push_back({row[0], row[1]});
  if (period)
  {
    const auto   first = points.front(), last = points.back();
    const double end = first.x + period->length, open = 1e-9 * period->length;
    if (last.x > end + open)
      throw table.error("table", "goes further than one period; give the rows of one, from the first on");
    if (last.x < end - open)
      points.push_back({end, first.f + period->rise});
    else if (std::abs(last.f - first.f - period->rise) >
             1e-9 * std::max({std::abs(last.f), std::abs(first.f), std::abs(period->rise)}))
      throw table.error("table",
                        "does not close: its last row, one period behind the first, must have the value of the "
                        "first plus 'rise'; correct it or leave it out");
  }
  const auto ends = period ? CubicSpline::Ends::periodic : CubicSpline::Ends::not_a_knot;
  try
  {
    const CubicSpline spline(points, ends);
    warn_of_overshoot(table, points, period.has_value(), spline);
    return std::make_shared<PositionFunction>(spline);
  }
  catch (const std::invalid_argument &e)
  {
    throw table.error("table", e.what());
  }
}

ScalarRequest read_scalar(const SceneTable &table, const std::string &key, const Names &names)
{
  const std::string name = table.text(key);
  if (const MeasureRequest *measure = names.find_measure(name))
  {
    if (measure->function || measure->terms.size() > 1)
      throw table.error(key, "the measure '" + name + "' is made of others itself; name plain ones");
    if (!measure->terms.empty())
      return {measure->terms[0], measure->unit, name};
    return {{1., {}, std::make_shared<MeasureRequest>(*measure)}, measure->unit, name};
  }
  std::vector<std::string> valid;
  for (const NamedScalar &known : coordinates(names))
  {
    if (known.name == name)
      return {{1., {known.term}, nullptr}, known.unit, name};
    valid.push_back(known.name);
  }
  const BodyRequest *body = names.find_body(name);
  throw table.error(key, body ? "'" + name + "' has several coordinates; name one, as '" + name +
                                    (body->kind == BodyKind::planar ? ".angle'" : ".ux'") + ", or a [measure]"
                              : "there is no measure or coordinate '" + name + "'" + suggestion(name, valid));
}

/// Angles that jump by a turn are no part of a sum, nor of a function that is not the same after it.
static void refuse_wrapping(const SceneTable &table, const std::string &key, const ScalarRequest &scalar)
{
  using Form = mechanism::RelativeMeasure::Form;
  if (scalar.term.placed && (scalar.term.placed->form == Form::angle || scalar.term.placed->form == Form::inclination))
    throw table.error(key,
                      "the angle '" + scalar.name +
                          "' jumps by a turn where it passes 180 degrees, which tears apart what is made of it; take "
                          "the angle of a rotor or planar body, or, as `from`, a function with a `period` and no "
                          "`rise`");
}

void refuse_turning_point(const SceneTable &table, const Names &names, const PlaceRequest &from, const PlaceRequest &to)
{
  for (const auto &[key, place] : {std::pair{"from", &from}, std::pair{"to", &to}})
  {
    const BodyRequest *body = names.find_body(place->marker);
    if (body && body->kind == coupling::BodyKind::point)
      throw table.error(key, "'" + place->marker +
                                 "' is a point, which has no rotation; make it a body of "
                                 "type \"planar\" or \"rigid\", or take a displacement");
  }
  for (const char *key : {"at_from", "at_to"})
    if (table.has(key))
      throw table.error(key, "is of no meaning: an angle is that of the whole body; leave it out");
}

MeasureRequest read_position_function(const SceneTable &table, const Names &names, ScalarRequest &x)
{
  x            = read_scalar(table, "from", names);
  const auto y = read_scalar(table, "to", names);
  if (table.text("from") == table.text("to"))
    throw table.error("to", "is '" + y.name + "' like `from`; a position function leads from one motion to another");
  if (x.term.weight != 1.)
    throw table.error("from", "'" + x.name +
                                  "' is a multiple of another motion; name that one, and put the factor into "
                                  "the function");
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

void refuse_jumps(const SceneTable &table, const PositionFunction &f, const Kind &x)
{
  if (!table.has("function") || !table.has("period"))
    return; // how far it is used is not known; where it jumps the run ends
  const double period = table.positive("period", x), begin = table.number("begin", x, 0.);
  const double aside = 1e-3 * period; // kinks like to lie at the begin, and no step of the search should end on one
  const auto   jump  = mechanism::first_jump(f, begin - M_SQRT1_2 * aside, begin + period - M_SQRT1_2 * aside);
  if (!jump)
    return;
  const bool         turns = x.refused == Counts::turns;
  const double       at    = std::round(1e9 * jump->x / period) / 1e9 * period + 0.; // located to rounding
  std::ostringstream text;
  text << jump->what << " jumps from " << jump->before << " to " << jump->behind << " at "
       << (turns ? at * 180. / M_PI : at) << (turns ? " deg" : "") << " (" << jump->kink
       << "), a blow that an ideal joint cannot tell; round the course off there, or let it act through a spring: an "
          "element on a measure of type \"position function\", instead of the joint";
  throw table.error("function", text.str());
}

MeasureRequest read_sum(const SceneTable &table, const Names &names)
{
  struct Part
  {
    SceneTable    table;
    ScalarRequest y;
    Quantity      factor; ///< a plain number takes the unit that makes its term fit
  };
  std::vector<Part> parts;
  MeasureRequest    measure;
  const auto        join = [&](const Part &part, const Dimension &sum)
  {
    const std::string unit = equal(sum, kind::length.dimension) ? "m" : equal(sum, kind::angle.dimension) ? "rad" : "";
    if (unit.empty() || (!measure.unit.empty() && unit != measure.unit))
      throw part.table.error("factor",
                             "makes a term of " + describe(sum) + "; all terms must be lengths, or all angles");
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
          throw part.table.error("factor", "is a number without unit, as all factors here, but the motions are lengths "
                                           "and angles; give one of the factors its unit, so that it is known what the "
                                           "sum is");
    if (measure.unit.empty())
      join(part, part.y.kind().dimension);
    measure.terms.push_back(part.y.term);
    measure.terms.back().weight *= part.factor.value;
  }
  if (measure.terms.empty())
    throw table.error("needs 'terms' such as [{ of = \"rack\" }, { of = \"pinion\", factor = \"-40 mm\" }]");
  return measure;
}

std::shared_ptr<const mechanism::MotionLaw> read_motion(const SceneTable &table, bool turns)
{
  if (table.has("speed") && (table.has("function") || table.has("table")))
    throw table.error("speed", "says the same as 'function' or 'table'; give one of them");
  if (table.has("speed"))
    return read_speed(table, turns);
  if (!table.has("function") && !table.has("table"))
    throw table.error("needs 'speed', or 'function', a formula of the time t, or 'table'");
  const auto f =
      read_function(table, {"t", "time", kind::time.dimension}, kind::time, turns ? kind::angle : kind::length);
  refuse_jumps(table, *f, kind::time);
  return std::make_shared<mechanism::FunctionMotion>(*f);
}

} // namespace gestell::apps
