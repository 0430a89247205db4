#include "apps/analysis/periodic/periodic_tables.h"

#include "fem/values/number_text.h"

#include <cmath>

namespace gestell::apps
{
namespace
{

/// Nothing where no parameter is followed.
std::optional<double> parameter_of(const PeriodicResult &result, double value)
{
  return result.parameter.empty() ? std::nullopt : std::optional(value);
}

std::vector<double> numbers_of(const SignalOrbit &signal)
{
  std::vector<double> numbers{signal.max, signal.min, signal.mean};
  for (std::size_t k = 0; k < signal.amplitude.size(); ++k)
    numbers.insert(numbers.end(), {signal.amplitude[k], signal.phase[k]});
  return numbers;
}

std::string kind_text(const coupling::Recurrence &motion)
{
  if (motion.kind == "periodic")
    return "periodic: repeats after one period of the excitation";
  if (motion.kind == "sub-harmonic")
    return "sub-harmonic: repeats after " + std::to_string(motion.repeats) + " periods of the excitation";
  if (motion.kind == "quasi-periodic")
    return "quasi-periodic: beating without repetition; nearby trajectories stay close";
  if (motion.kind == "drifting")
    return "drifting: moves away over these periods, like an unconstrained coordinate";
  if (motion.kind == "chaotic")
    return "chaotic: no repetition; nearby trajectories diverge";
  return "still settling: converges to a periodic solution" +
         (motion.repeats > 0
              ? " of " + std::to_string(motion.repeats) + " excitation period" + (motion.repeats > 1 ? "s" : "")
              : std::string());
}

std::string range_text(const std::string &name, double begin, double end)
{
  return name + " from " + short_text(begin, 4) + " to " + short_text(end, 4);
}

std::string percent(double share)
{
  return short_text(100. * share, 3) + " %";
}

} // namespace

std::string parameter_head(const PeriodicResult &result)
{
  return result.parameter.empty()
             ? "parameter"
             : result.parameter + (result.parameter_unit.empty() ? "" : " [" + result.parameter_unit + "]");
}

std::string kind_of(const coupling::PeriodicSolution &solution)
{
  return solution.ratio > 1 ? "sub-harmonic 1/" + std::to_string(solution.ratio) : "periodic";
}

CsvTable solutions_csv(const PeriodicResult &result)
{
  std::vector<std::string> heads{"solution", "branch", parameter_head(result), "period [s]", "period ratio",
                                 "residual", "stable", "largest multiplier",   "kind"};
  if (!result.entries.empty())
    for (const SignalOrbit &signal : result.entries.front().signals)
    {
      for (const char *what : {" max", " min", " mean"})
        heads.push_back(signal.name + what);
      for (std::size_t k = 1; k <= signal.amplitude.size(); ++k)
        for (const char *what : {" a", " phi"})
          heads.push_back(signal.name + what + std::to_string(k));
    }
  CsvTable csv(heads);
  int      number = 0;
  for (const PeriodicEntry &entry : result.entries)
  {
    const coupling::PeriodicSolution &s = entry.solution;
    std::vector<std::vector<double>>  signals;
    for (const SignalOrbit &signal : entry.signals)
      signals.push_back(numbers_of(signal));
    csv.add(++number, entry.branch, parameter_of(result, entry.parameter), s.period, s.ratio, s.residual,
            !s.stability_is_known() ? ""
            : s.stable()            ? "yes"
                                    : "no",
            s.largest_multiplier(), kind_of(s), signals);
  }
  return csv;
}

CsvTable multipliers_csv(const PeriodicResult &result)
{
  CsvTable csv({"solution", "re", "im", "abs"});
  int      number = 0;
  for (const PeriodicEntry &entry : result.entries)
  {
    ++number;
    for (const auto &mu : entry.solution.multipliers)
      csv.add(number, mu.real(), mu.imag(), std::abs(mu));
  }
  return csv;
}

CsvTable special_points_csv(const PeriodicResult &result)
{
  CsvTable csv({"kind", parameter_head(result), "period [s]", "solution"});
  for (const SpecialPoint &point : result.special_points)
    csv.add(point.kind, parameter_of(result, point.parameter), point.period, point.solution);
  return csv;
}

std::vector<std::pair<std::string, std::string>> orbit_files(const PeriodicResult &result)
{
  std::vector<std::pair<std::string, std::string>> files;
  for (const PeriodicEntry &entry : result.entries)
  {
    std::vector<std::string> heads{"t [s]"};
    for (const SignalOrbit &signal : entry.signals)
      heads.push_back(signal.name + " [" + signal.unit + "]");
    CsvTable csv(heads);
    csv.add_rows(entry.rows);
    files.emplace_back("orbit_" + std::to_string(files.size() + 1) + ".csv", csv);
  }
  return files;
}

CsvTable section_csv(const PeriodicResult &result)
{
  if (!result.long_run)
    return {};
  const LongRun           &run = *result.long_run;
  std::vector<std::string> heads{"period"};
  for (const NamedCoordinate &coordinate : result.coordinates)
    heads.insert(heads.end(), {coordinate.name, coordinate.name + "'"});
  heads.insert(heads.end(), run.columns.begin(), run.columns.end());
  CsvTable               csv(heads);
  const Eigen::MatrixXd &section = run.motion.section;
  const auto             n       = section.rows() / 2;
  auto                   signals = run.rows.begin();
  for (Eigen::Index k = 0; k < section.cols(); ++k)
  {
    std::vector<double> numbers;
    for (Eigen::Index i = 0; i < n; ++i)
      for (const double x : {section(i, k), section(n + i, k)})
        numbers.push_back(result.coordinates[std::size_t(i)].sign * x);
    for (std::size_t j = 0; j < run.columns.size(); ++j)
      numbers.push_back(*signals++);
    csv.add(run.motion.periods + k, numbers);
  }
  return csv;
}

CsvTable basins_csv(const PeriodicResult &result)
{
  if (!result.basins)
    return {};
  const coupling::Basins &basins = result.basins->basins;
  CsvTable                csv({result.basins->x_name, result.basins->y_name, "solution", "periods"});
  for (int j = 0; j < basins.plane.points; ++j)
    for (int i = 0; i < basins.plane.points; ++i)
      if (basins.motion(i, j) != coupling::Basins::not_looked_at)
        csv.add(basins.plane.x_at(i), basins.plane.y_at(j), basins.motion(i, j), basins.periods(i, j));
  return csv;
}

std::string long_run_text(const LongRun &run)
{
  const coupling::Recurrence &motion = run.motion;
  return "long-term behaviour (" + std::to_string(motion.periods) +
         " periods after an equally long transient): " + kind_text(motion) + "; largest Lyapunov exponent " +
         short_text(motion.exponent, 3) + " 1/s, standard error " + short_text(motion.error, 2) + " 1/s";
}

std::string basins_text(const BasinMap &map)
{
  const coupling::Basins &basins = map.basins;
  std::string text = "basins of attraction over " + range_text(map.x_name, basins.plane.x_begin, basins.plane.x_end) +
                     ", " + range_text(map.y_name, basins.plane.y_begin, basins.plane.y_end) + ":";
  for (int number = 1; number <= basins.motion.maxCoeff(); ++number)
    if (const double share = basins.share(number); share > 0.)
      text += " no. " + std::to_string(number) + ": " + percent(share) + ",";
  text += " none of the stable solutions found: " + percent(basins.share(coupling::Basins::not_reached));
  return text + (basins.is_complete() ? "" : "; interrupted");
}

} // namespace gestell::apps
