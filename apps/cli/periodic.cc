#include "apps/analysis/result_folder.h"
#include "apps/cli/command.h"
#include "apps/cli/interruption.h"
#include "apps/cli/json_answer.h"
#include "apps/cli/progress.h"
#include "apps/cli/results_path.h"
#include "apps/output/tables/noise.h"
#include "apps/output/tables/periodic_tables.h"
#include "apps/output/tables/summary_json.h"
#include "apps/session/session.h"
#include "coupling/periodic/periodic_methods.h"
#include "coupling/periodic/verified_orbit.h"
#include "fem/values/number_text.h"

#include <cmath>
#include <iomanip>
#include <iostream>
#include <limits>
#include <memory>

namespace gestell::apps
{

namespace
{

std::string stability_text(const coupling::PeriodicSolution &solution)
{
  if (!solution.stability_is_known())
    return "unknown";
  const coupling::RunVerification &run = solution.verification;
  return (solution.stable() ? "stable, "
          : run.leaves      ? "left by a run, "
                            : "unstable, ") +
         short_text(solution.largest_multiplier(), 4) +
         (run.periods == coupling::verified_periods && !run.leaves
              ? " (a run of " + std::to_string(run.periods) + " periods stays within " + short_text(run.departure, 2) +
                    ")"
              : "");
}

void print_signals(const PeriodicEntry &entry)
{
  const Noise noise = noise_of(entry.signals);
  for (const SignalOrbit &signal : entry.signals)
    std::cout << "    " << std::left << std::setw(12) << signal.name << std::right << " max " << std::setw(12)
              << short_text(noise.without(signal.unit, signal.max), 6) << "  min " << std::setw(12)
              << short_text(noise.without(signal.unit, signal.min), 6) << "  a1 " << std::setw(12)
              << (signal.amplitude.empty() ? "" : short_text(signal.amplitude[0], 6)) << "  " << signal.unit << '\n';
}

void print_solutions(const PeriodicResult &result)
{
  std::cout << result.method << ": " << result.reason << '\n';
  int                   number    = 0;
  constexpr std::size_t most_rows = 40; // of standard output, a screen; the file has all
  for (const PeriodicEntry &entry : result.entries)
  {
    if (++number > int(most_rows))
      break;
    const coupling::PeriodicSolution &s = entry.solution;
    std::cout << "  " << number << "  ";
    if (!result.parameter.empty())
      std::cout << result.parameter << " = " << short_text(entry.parameter, 8) << ", ";
    std::cout << kind_of(s) << ", period " << short_text(s.period, 10) << " s, " << stability_text(s) << ", closes to "
              << short_text(s.residual, 2);
    if (!std::isnan(s.share))
      std::cout << ", from " << short_text(100. * s.share, 3) << " % of the starts";
    if (s.method != result.method && !coupling::periodic_method(result.method).finds_all() && !s.method.empty())
      std::cout << ", found by " << s.method;
    std::cout << '\n';
    if (result.parameter.empty())
      print_signals(entry);
    for (const std::string &note : s.notes)
      std::cout << "    " << note << '\n';
  }
  if (result.entries.size() > most_rows)
    std::cout << "  ... " << result.entries.size() << " in all, in solutions.csv\n";
  for (const SpecialPoint &point : result.special_points)
    std::cout << "  " << point.kind << " at " << result.parameter << " = " << short_text(point.parameter, 10) << '\n';
  if (result.long_run)
    std::cout << "  " << long_run_text(*result.long_run) << '\n';
  if (result.basins)
    std::cout << "  " << basins_text(*result.basins) << '\n';
  for (const std::string &note : result.notes)
    std::cout << "  " << note << '\n';
  number = 0;
  for (const PeriodicCheck &check : result.checks)
  {
    std::cout << "  " << ++number << "  by " << check.method << ": ";
    if (!check.failure.empty())
      std::cout << check.failure;
    for (const auto &[name, distance] : check.distances)
      std::cout << name << " differs by " << short_text(distance, 2) << " of its amplitude  ";
    std::cout << '\n';
  }
}

std::string names_of_methods()
{
  std::string names;
  for (const coupling::PeriodicMethod *method : coupling::periodic_methods())
    names += (names.empty() ? "" : ", ") + method->name();
  return names;
}

/// The request as typed; options of single methods have no value if they are not given.
struct TypedRequest
{
  static constexpr int not_given = std::numeric_limits<int>::min();

  PeriodicRequest               request;
  std::map<std::string, int>    counts;
  std::map<std::string, double> numbers;

  PeriodicRequest whole() const
  {
    PeriodicRequest all = request;
    for (const auto &[name, count] : counts)
      if (count != not_given)
        all.own[name] = count;
    for (const auto &[name, number] : numbers)
      if (!std::isnan(number))
        all.own[name] = number;
    return all;
  }

  CommandOption option(const coupling::PeriodicOption &of)
  {
    const std::string   name = "--" + of.name;
    const CommandOption typed =
        of.whole ? CommandOption{name, &(counts[of.name] = not_given), of.meaning}
                 : CommandOption{name, &(numbers[of.name] = std::numeric_limits<double>::quiet_NaN()), of.meaning};
    return (of.least > 0. || !of.whole ? typed.above_zero() : typed).at_most(of.most);
  }
};

int find_periodic(const CommonOptions &options, const PeriodicRequest &request)
{
  ProgressLine progress(options.quiet);
  const auto   on_progress = nothing_to_save_before("periodic motions", progress.callback());
  Session      session(options.input, options.overrides, options.scripts, {on_progress, &interruption()});
  session.check();
  const std::filesystem::path folder = results_path(options, session.scene());
  const ResultsLock           held(folder);
  const auto                  inputs = inputs_of(options);
  require_room(folder, {}, inputs);
  const Result result = session.periodic(request);
  progress.done();
  prepare_folder(folder, inputs);
  write_results(folder, result);
  if (answers_in_json())
    answer_with(summary_json(result));
  print_solutions(*result.periodic);
  for (const std::string &warning : result.warnings)
    std::cerr << "gestell: warning: " << warning << '\n';
  std::cout << "report: " << (folder / "report.html").string() << '\n';
  if (result.periodic->interrupted)
    return exit_interrupted;
  if (result.periodic->failure.empty())
    return exit_done;
  std::cerr << "gestell: the computation failed: " << result.periodic->failure << '\n';
  return exit_failed;
}

} // namespace

Command periodic_command()
{
  const auto typed = std::make_shared<TypedRequest>();
  const auto own   = &typed->request;
  Command    command{
      "periodic",
      "periodic motions and whether they last",
      {"gestell periodic apps/scenes/press.toml",
          "gestell periodic apps/scenes/press.toml --along parameters.s_cl --from \"0.1 mm\" --to \"0.6 mm\""},
      CommandInput::scene,
      {{"--method", &own->method, names_of_methods() + " (default: chosen by the scene; the reason is printed)"},
          {"--period", &own->period, "of the excitation, such as \"0.2 s\" (default: from loads and what turns)"},
          CommandOption{"--ratio", &own->ratio, "periods of the excitation after which the motion repeats (default 1)"}
              .above_zero()
              .at_most(1000),
          {"--along", &own->along, "follow the motions along an entry of the scene, such as parameters.speed"},
          CommandOption{"--from", &own->from, "its first value, such as \"800 1/min\""}.with("--along"),
          CommandOption{"--to", &own->to, "its last value"}.with("--along"),
          CommandOption{"--points", &own->points, "about so many from end to end (default 100)"}
              .above_zero()
              .at_most(1e6)
              .with("--along"),
          CommandOption{"--closing", &own->tolerance,
                     "how well a motion must close, relative to its speed (default 1e-10)"}
              .above_zero(),
          CommandOption{"--check", &own->check,
                     "compute each motion by a second method too, and report how far the two differ"},
          {"--basins", &own->basins,
           "to which motion starts settle that differ in two coordinates or rates, such as \"slide, slide'\" or \"slide "
              "from -1 to 1, slide' from -2 to 2\" (default ends: twice the largest excursions of the motions found)"},
          CommandOption{"--basin-points", &own->basin_points, "starts along a side (default 60)"}
              .above_zero()
              .at_most(2000)
              .with("--basins"),
          CommandOption{"--section", &own->section,
                     "follow the motion for so many periods, 64 or more, and tell what it does in the long run "
                        "(default: 256 where no motion is found, of minimise none that lasts)"}
              .above_zero()
              .at_most(1e6)},
      [typed](const CommonOptions &options) { return find_periodic(options, typed->whole()); }};
  for (const coupling::PeriodicOption &option : coupling::options_of_periodic_methods())
    command.options.push_back(typed->option(option));
  return command;
}

} // namespace gestell::apps
