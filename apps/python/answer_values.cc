#include "apps/python/answer_values.h"

#include "apps/output/describe/described_json.h"

#include <pybind11/complex.h>
#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <limits>

namespace gestell::python
{
namespace
{

namespace py = pybind11;
using namespace pybind11::literals;

py::array_t<double> numbers(const std::vector<double> &values)
{
  return py::array_t<double>(py::ssize_t(values.size()), values.data());
}

/// Array [rows x columns] of values in row-major order.
py::array_t<double> table(const std::vector<double> &values, std::size_t columns)
{
  const std::size_t rows = columns == 0 ? 0 : values.size() / columns;
  return py::array_t<double>({py::ssize_t(rows), py::ssize_t(columns)}, values.data());
}

/// @param signs  of coordinates, against their names
py::dict motion_values(const apps::PeriodicEntry &entry, const Eigen::VectorXd &signs)
{
  const coupling::PeriodicSolution &s     = entry.solution;
  const auto                        named = [&](const Eigen::VectorXd &x)
  { return x.size() == signs.size() ? Eigen::VectorXd(signs.cwiseProduct(x)) : x; };
  py::dict signals;
  for (const apps::SignalOrbit &signal : entry.signals)
    signals[py::str(signal.name)] =
        py::dict("unit"_a = signal.unit, "max"_a = signal.max, "min"_a = signal.min, "mean"_a = signal.mean,
                 "amplitude"_a = numbers(signal.amplitude), "phase"_a = numbers(signal.phase));
  py::object stable = py::none();
  if (s.stability_is_known())
    stable = py::bool_(s.stable());
  py::list names;
  names.append("t");
  for (const apps::SignalOrbit &signal : entry.signals)
    names.append(signal.name);
  return py::dict("period"_a = s.period, "begin"_a = s.begin, "ratio"_a = s.ratio, "kind"_a = apps::kind_of(s),
                  "residual"_a = s.residual, "stable"_a = stable, "multipliers"_a = s.multipliers, "q"_a = named(s.q),
                  "v"_a = named(s.v), "method"_a = s.method, "notes"_a = s.notes, "branch"_a = entry.branch,
                  "parameter"_a = entry.parameter, "signals"_a = signals, "columns"_a = names,
                  "orbit"_a = table(entry.rows, entry.signals.size() + 1));
}

} // namespace

py::dict periodic_values(const apps::PeriodicResult &found)
{
  py::list        motions, points, backbone, coordinates;
  Eigen::VectorXd signs(Eigen::Index(found.coordinates.size()));
  for (std::size_t i = 0; i < found.coordinates.size(); ++i)
  {
    coordinates.append(found.coordinates[i].name);
    signs[Eigen::Index(i)] = found.coordinates[i].sign;
  }
  for (const apps::PeriodicEntry &entry : found.entries)
    motions.append(motion_values(entry, signs));
  for (const apps::PeriodicEntry &entry : found.backbone)
    backbone.append(motion_values(entry, signs));
  for (const apps::SpecialPoint &point : found.special_points)
    points.append(py::dict("kind"_a = point.kind, "parameter"_a = point.parameter, "period"_a = point.period,
                           "motion"_a = point.solution - 1));
  py::dict checks;
  for (const apps::PeriodicCheck &check : found.checks)
    checks[py::str(check.method)] =
        py::dict("distances"_a = py::dict(py::cast(check.distances)), "failure"_a = check.failure);
  return py::dict("method"_a = found.method, "reason"_a = found.reason, "parameter"_a = found.parameter,
                  "unit"_a = found.parameter_unit, "coordinates"_a = coordinates, "motions"_a = motions,
                  "special_points"_a = points, "backbone"_a = backbone, "checks"_a = checks, "notes"_a = found.notes);
}

py::dict along_values(const apps::AlongResult &along)
{
  const auto      &positions = along.modes.positions;
  const auto       rows = Eigen::Index(positions.size()), lines = Eigen::Index(along.modes.moves_most.size());
  Eigen::VectorXd  x(rows);
  constexpr double nan         = std::numeric_limits<double>::quiet_NaN();
  Eigen::MatrixXd  frequencies = Eigen::MatrixXd::Constant(rows, lines, nan), damping = frequencies,
                  assurance = frequencies;
  std::vector<Eigen::MatrixXd> shapes;
  py::dict                     gaps;
  for (Eigen::Index i = 0; i < rows; ++i)
  {
    const coupling::ModesAt &at = positions[std::size_t(i)];
    x[i]                        = at.x;
    if (!at.gap.empty())
      gaps[py::int_(i)] = at.gap;
    Eigen::MatrixXd here;
    for (Eigen::Index j = 0; j < std::min(lines, Eigen::Index(at.modes.size())); ++j)
    {
      const coupling::Mode &mode = at.modes[std::size_t(j)];
      frequencies(i, j)          = mode.frequency_hz;
      damping(i, j)              = mode.damping_ratio;
      if (std::size_t(j) < at.assurance.size())
        assurance(i, j) = at.assurance[std::size_t(j)];
      if (here.size() == 0)
        here = Eigen::MatrixXd::Constant(mode.shape.size(), lines, nan);
      here.col(j) = mode.shape;
    }
    shapes.push_back(here);
  }
  py::list meetings;
  for (const coupling::OrderMeeting &m : along.meetings)
    meetings.append(py::dict("order"_a = m.order, "line"_a = m.line, "begin"_a = m.begin, "end"_a = m.end, "x"_a = m.x,
                             "frequency_hz"_a = m.frequency_hz, "distance"_a = m.distance));
  return py::dict("coordinate"_a = along.modes.coordinate.name, "unit"_a = along.modes.coordinate.unit, "x"_a = x,
                  "frequencies_hz"_a = frequencies, "damping_ratios"_a = damping, "assurance"_a = assurance,
                  "shapes"_a = shapes, "moves_most"_a = along.modes.moves_most, "gaps"_a = gaps,
                  "speed"_a = along.speed, "meetings"_a = meetings);
}

std::string size_values(const apps::SizeResult &found)
{
  using apps::described_json;
  return apps::json_text(
      {{"size", described_json(found)}, {"ladder", described_json(found.ladder)}, {"all", described_json(found.all)}});
}

} // namespace gestell::python
