#include "apps/analysis/periodic/basin_answer.h"

#include "apps/scene/build/build_machine.h"
#include "apps/session/option_value.h"
#include "coupling/machine/configuration/assembly.h"
#include "coupling/periodic/trace_orbit.h"
#include "fem/values/available_memory.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

namespace gestell::apps
{

namespace
{
using Eigen::VectorXd;

/// A side of the plane, as it is typed.
struct PlaneSide
{
  std::string                              name;
  int                                      index = 0;  ///< in (q, q')
  double                                   sign  = 1.; ///< in it, of what the name names
  std::optional<std::pair<double, double>> ends;
};

std::string trimmed(const std::string &text)
{
  const auto first = text.find_first_not_of(' ');
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(' ') - first + 1);
}

/// Numbers are SI; with a unit a length or an angle, of rates a speed of either.
double end_value(const std::string &text, bool is_rate)
{
  try
  {
    return option_value("--basins", text, is_rate ? kind::speed : kind::length);
  }
  catch (const std::invalid_argument &)
  {
    return option_value("--basins", text, is_rate ? kind::angular_speed : kind::angle);
  }
}

PlaneSide side_of(const coupling::Machine &machine, const std::string &text)
{
  PlaneSide  side;
  const auto from = text.find(" from "), to = text.find(" to ");
  side.name = trimmed(text.substr(0, from));
  if (side.name.empty() || (from == std::string::npos) != (to == std::string::npos) || to < from)
    throw std::invalid_argument("--basins: \"" + trimmed(text) +
                                "\" is not an axis of the plane; name a coordinate, such as \"" +
                                machine.coordinate_name(0) + "\", its rate \"" + machine.coordinate_name(0) +
                                "'\", or one with its range, \"" + machine.coordinate_name(0) + " from -1 to 1\"");
  const bool        is_rate    = side.name.back() == '\'';
  const std::string coordinate = is_rate ? side.name.substr(0, side.name.size() - 1) : side.name;
  try
  {
    const int i = machine.model().coordinate(coordinate);
    side.index  = i + (is_rate ? machine.size() : 0);
    side.sign   = coordinate_sign(machine, i);
  }
  catch (const std::invalid_argument &unknown)
  {
    throw std::invalid_argument(std::string("--basins: ") + unknown.what());
  }
  if (from == std::string::npos)
    return side;
  side.ends.emplace(end_value(trimmed(text.substr(from + 6, to - from - 6)), is_rate),
                    end_value(trimmed(text.substr(to + 4)), is_rate));
  if (!(side.ends->second > side.ends->first))
    throw std::invalid_argument("--basins: \"" + trimmed(text) + "\" is an empty range; give the smaller value first");
  return side;
}

std::pair<PlaneSide, PlaneSide> sides_of(const coupling::Machine &machine, const std::string &text)
{
  const auto comma = text.find(',');
  if (comma == std::string::npos || text.find(',', comma + 1) != std::string::npos)
    throw std::invalid_argument("--basins \"" + text + "\": a plane has two axes, such as \"" +
                                machine.coordinate_name(0) + ", " + machine.coordinate_name(0) + "'\"");
  const std::pair<PlaneSide, PlaneSide> sides = {side_of(machine, text.substr(0, comma)),
                                                 side_of(machine, text.substr(comma + 1))};
  if (sides.first.index == sides.second.index)
    throw std::invalid_argument("--basins \"" + text + "\": the two axes are the same; name two different ones");
  return sides;
}

/// Smallest and largest (q, q') over all motions, without the linear growth of rotating coordinates [2n].
std::pair<VectorXd, VectorXd> extremes(const coupling::PeriodicProblem               &problem,
                                       const std::vector<coupling::PeriodicSolution> &solutions)
{
  const auto n   = problem.turn.size();
  VectorXd   low = VectorXd::Constant(2 * n, HUGE_VAL), high = -low;
  for (const coupling::PeriodicSolution &solution : solutions)
  {
    coupling::PeriodicProblem own = problem;
    own.period                    = solution.period;
    constexpr int samples         = 256; // of a period: extremes to (pi / 256)^2 / 2 = 0.01 %
    coupling::trace(own, solution, samples * solution.ratio,
                    [&](const coupling::OrbitPoint &point)
                    {
                      VectorXd x(2 * n);
                      x << point.q - (point.t - solution.begin) / solution.period * solution.turn, point.v;
                      low  = low.cwiseMin(x);
                      high = high.cwiseMax(x);
                    });
  }
  return {low, high};
}

std::pair<double, double> ends_of(const PlaneSide &side, const std::pair<VectorXd, VectorXd> &motion)
{
  if (side.ends)
    return *side.ends;
  const double     one = side.sign * motion.first[side.index], other = side.sign * motion.second[side.index];
  const double     low = std::min(one, other), high = std::max(one, other);
  constexpr double excursions = 2.; // extent of the plane in both directions, in excursions of the motions
  const double     middle = 0.5 * (low + high), reach = 0.5 * excursions * (high - low);
  if (!(reach > 0.))
    throw std::invalid_argument("--basins: " + side.name + " is constant in the solutions found; give a range, \"" +
                                side.name + " from ... to ...\"");
  return {middle - reach, middle + reach};
}

} // namespace

void check_basins(const coupling::Machine &machine, const coupling::PeriodicProblem &problem,
                  const PeriodicRequest &request)
{
  if (request.basins.empty())
    return;
  sides_of(machine, request.basins);
  constexpr double bytes_of_start = 8.; // the motion it settles to, and after how many periods
  fem::require_available("--basin-points " + std::to_string(request.basin_points) +
                             ": a plane with this number of initial states per axis",
                         bytes_of_start * request.basin_points * double(request.basin_points), "Use fewer points.");
  if (!request.along.empty())
    throw std::invalid_argument("--basins applies to one machine, but --along varies it; omit one of the two options");
  if (coupling::has_joints(machine))
    throw std::invalid_argument(
        "--basins: initial states that differ in single coordinates violate the ideal joints of the machine; instead "
        "compute solutions from several [start] tables, which assemble the joints");
  if (problem.period_is_unknown())
    throw std::invalid_argument("--basins: the period is unknown, and initial states would differ in phase only; "
                                "basins need a load or drive with a known period");
}

coupling::StartPlane start_plane(const coupling::Machine &machine, const coupling::PeriodicProblem &problem,
                                 const std::vector<coupling::PeriodicSolution> &solutions,
                                 const PeriodicRequest                         &request)
{
  const auto [x, y]           = sides_of(machine, request.basins);
  const auto motion           = extremes(problem, solutions);
  const auto [x_begin, x_end] = ends_of(x, motion);
  const auto [y_begin, y_end] = ends_of(y, motion);
  constexpr int usual_points  = 60; // 3600 starts, each a motion of many periods
  const int     points        = request.basin_points > 0 ? request.basin_points : usual_points;
  return {x.index, y.index, x_begin, x_end, y_begin, y_end, points, x.sign, y.sign};
}

void find_basins(const coupling::Machine &machine, const coupling::PeriodicProblem &problem,
                 const coupling::PeriodicGuess &start, const std::vector<coupling::PeriodicSolution> &solutions,
                 const coupling::PeriodicOptions &options, const PeriodicRequest &request,
                 const std::function<void(double)> &progress, PeriodicResult &found)
{
  if (request.basins.empty() || problem.interrupted())
    return;
  if (std::none_of(solutions.begin(), solutions.end(), [](const auto &solution) { return solution.stable(); }))
  {
    found.notes.push_back("no basins of attraction: none of the solutions found is stable");
    return;
  }
  BasinMap map;
  map.basins =
      basins_of(problem, solutions, start, start_plane(machine, problem, solutions, request), options, progress);
  const auto [x, y] = sides_of(machine, request.basins);
  map.x_name        = x.name;
  map.y_name        = y.name;
  found.basins      = std::move(map);
  found.work.add(found.basins->basins.work);
}

} // namespace gestell::apps
