#include "apps/analysis/result_folder.h"
#include "apps/cli/chart/chart_files.h"
#include "apps/cli/chart/chart_methods.h"
#include "apps/cli/chart/chart_reductions.h"
#include "apps/cli/chart/chart_reference.h"
#include "apps/cli/chart/work_measurement.h"
#include "apps/cli/command.h"
#include "apps/cli/interruption.h"
#include "apps/cli/progress.h"
#include "apps/cli/results_path.h"
#include "apps/output/charts/work_precision.h"
#include "apps/output/folder/own_folder.h"
#include "apps/scene/language/parse_quantity.h"
#include "apps/scene/language/quantity.h"
#include "apps/scene/variant.h"
#include "apps/session/prepared_machine.h"
#include "apps/version.h"
#include "fem/values/nearest_name.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <optional>

namespace gestell::apps
{
namespace
{

/// Selection for `gestell chart`; empty lists: chosen for the scene.
struct ChartCommandOptions
{
  std::vector<std::string> methods;          ///< keys such as "exact-6", "cvode-5", "bdf*"
  std::vector<std::string> steps;            ///< of fixed steps, "10 us" or plain numbers in s
  std::vector<std::string> tolerances;       ///< of controlled steps and of peers
  std::vector<std::string> errors;           ///< errors for which a choice is given
  std::vector<std::string> signals;          ///< for the errors; "q*" for all with this beginning
  std::vector<int>         modes;            ///< numbers of modes of the reduced frame
  std::string              reference;        ///< CSV file; empty: an own fine run
  std::string              events  = "both"; ///< "both", "on" or "off"
  bool                     peers   = true;   ///< general-purpose libraries as well
  bool                     native  = false;  ///< vectors of peers compiled for this processor
  bool                     quick   = false;  ///< fewer methods and settings
  int                      samples = 2000;   ///< instants errors are measured at
  double                   limit   = 0.;     ///< [s] of CPU time for one run; 0: 20, quick 5
  ReductionChart           reductions;       ///< these are compared instead of methods of integration
};

double option_value(const std::string &option, const std::string &text, Kind dimension)
{
  const auto no_parameter = [](const std::string &) { return std::optional<Quantity>(); };
  try
  {
    char        *end   = nullptr;
    const double plain = std::strtod(text.c_str(), &end);
    const double value = *end == '\0' && !text.empty()
                             ? plain
                             : value_as(parse_quantity(text, no_parameter, {}, &dimension), dimension, text);
    if (value > 0. && std::isfinite(value))
      return value;
  }
  catch (const std::invalid_argument &error)
  {
    throw std::invalid_argument(option + ": " + error.what());
  }
  throw std::invalid_argument(option + ": needs a number above zero, got " + text);
}

/// Without the rounding of unit conversion: 1e-05, not 9.999999999999999e-06.
double rounded(double x)
{
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), "%.12g", x);
  return std::strtod(text.data(), nullptr);
}

/// Values of a list given on the command line, or else the default, from coarse to fine.
std::vector<double> ladder(const std::string &option, const std::vector<std::string> &given, Kind dimension,
                           std::vector<double> otherwise)
{
  std::vector<double> values;
  for (const std::string &text : given)
    values.push_back(rounded(option_value(option, text, dimension)));
  if (values.empty())
    values = std::move(otherwise);
  std::sort(values.rbegin(), values.rend());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

std::vector<double> default_steps(const Scene &scene, bool quick)
{
  const coupling::RunOptions &run  = scene.run.options;
  const double                own  = run.method.tolerance > 0. ? 0. : run.method.step;
  const double                base = own > 0. ? own : (run.end - run.begin) / 20000.;
  std::vector<double>         steps;
  for (int k = 5; k >= -3; k -= quick ? 2 : 1)
    steps.push_back(rounded(std::ldexp(base, k)));
  return steps;
}

std::vector<double> default_tolerances(bool quick)
{
  std::vector<double> tolerances;
  for (int k = 2; k <= (quick ? 6 : 10); k += quick ? 2 : 1)
    tolerances.push_back(std::pow(10., -k));
  return tolerances;
}

bool named(const std::string &name, const std::vector<std::string> &wanted)
{
  return std::any_of(wanted.begin(), wanted.end(),
                     [&](const std::string &w) {
                       return w == name ||
                              (!w.empty() && w.back() == '*' && name.compare(0, w.size() - 1, w, 0, w.size() - 1) == 0);
                     });
}

/// The signals for the errors: those named, those in the file, those of the scene, or the interface and the bodies.
std::vector<coupling::Signal> choose_signals(const Scene &scene, coupling::Machine &machine,
                                             const ChartCommandOptions &chart, const std::optional<ReferenceFile> &file)
{
  std::vector<coupling::Signal> all = scene_signals(scene, machine), chosen;
  if (all.empty())
    for (int i = 0; i < machine.size(); ++i)
      if (i < machine.model().n_interface() || i >= machine.model().n_frame())
      {
        coupling::Signal coordinate;
        coordinate.name = machine.coordinate_name(i);
        coordinate.on_q = {{i, 1.}};
        all.push_back(coordinate);
      }
  for (const coupling::Signal &signal : all)
    if ((chart.signals.empty() || named(signal.name, chart.signals)) && (!file || file->has(signal.name)))
      chosen.push_back(signal);
  if (chosen.empty())
  {
    std::vector<std::string> names;
    for (const coupling::Signal &signal : all)
      names.push_back(signal.name);
    throw std::invalid_argument(std::string(file ? "--reference" : "--signals") +
                                ": none of the signals of the scene (" + listed(names) + ") is listed there");
  }
  return chosen;
}

/// All runs of one method on one model, from coarse to fine, as long as they are useful.
class SeriesRun
{
public:
  SeriesRun(const WorkProblem &problem, const SignalSamples &reference, const WorkModel &model,
            const MotionScales &scales, double longest)
      : problem_(problem), reference_(reference), model_(model), scales_(scales), longest_(longest)
  {
  }

  void run(const ChartMethod &method, bool events, int model, const std::vector<double> &settings,
           const std::function<void(const WorkPoint &)> &tell, std::vector<WorkPoint> &points) const
  {
    if (events && !locates_events(method))
      return;
    double last_cpu = 0., last_setting = 0.;
    for (const double setting : settings)
    {
      // A method of order p needs work like tolerance^(-1/p), steps like 1/step: what is bound to fail is not tried.
      if (!method.controlled && last_cpu * last_setting / setting > 1.3 * problem_.cpu_limit)
        return;
      WorkPoint point;
      point.method                                       = method.name;
      point.family                                       = method.family;
      point.own                                          = !method.peer;
      point.events                                       = events;
      point.model                                        = model;
      (method.controlled ? point.tolerance : point.step) = setting;
      tell(point);
      const WorkRun result = one(method, events, setting);
      if (problem_.stop && problem_.stop->load(std::memory_order_relaxed))
        return;
      point.cpu_s    = result.cpu_s;
      point.setup_s  = result.setup_s;
      point.work     = result.work;
      point.n_events = result.events;
      point.failure  = result.failure;
      if (!method.peer)
        point.settings = scene_settings(method, setting, events);
      if (point.failure.empty() && reference_.size() == 0)
        point.failure = "no reference to measure its error against";
      else if (point.failure.empty())
      {
        point.error = scaled_error(result.values, reference_);
        // times the error of the reference, which is then within a tenth of the point's height
        constexpr double resolved_above = 10.;
        point.resolved                  = point.error >= resolved_above * model_.reference_error;
      }
      points.push_back(point);
      if (result.cpu_s > problem_.cpu_limit || (point.failure.empty() && !point.resolved))
        return;
      last_cpu     = result.cpu_s;
      last_setting = setting;
    }
  }

private:
  WorkRun one(const ChartMethod &method, bool events, double setting) const
  {
    try
    {
      if (method.peer)
      {
        peers::PeerOptions options                             = *method.peer;
        (method.controlled ? options.tolerance : options.step) = setting;
        options.events                                         = events;
        options.cpu_limit                                      = problem_.cpu_limit;
        return measure(problem_, options, scales_);
      }
      coupling::MethodOptions options                        = method.own;
      (method.controlled ? options.tolerance : options.step) = setting;
      if (method.controlled)
        options.step = longest_;
      return measure(problem_, options, events);
    }
    catch (const std::invalid_argument &reason)
    {
      WorkRun failed;
      failed.failure = reason.what();
      return failed;
    }
  }

  const WorkProblem   &problem_;
  const SignalSamples &reference_;
  const WorkModel     &model_;
  const MotionScales  &scales_;
  double               longest_;
};

struct ChartRequest
{
  const CommonOptions         &common;
  const ChartCommandOptions   &chart;
  std::optional<ReferenceFile> file;
  std::vector<bool>            events;
};

/// Everything for one size of the model; gives its reference back to compare sizes.
/// Motion of a model at the instants that errors are measured at.
WorkProblem problem_of(const ChartRequest &request, const Scene &scene, coupling::Machine &machine,
                       const coupling::InitialState &initial)
{
  WorkProblem problem{machine, initial};
  problem.begin     = scene.run.options.begin;
  problem.signals   = choose_signals(scene, machine, request.chart, request.file);
  problem.cpu_limit = request.chart.limit > 0. ? request.chart.limit : request.chart.quick ? 5. : 20.;
  if (request.chart.quick)
    problem.repeat_s = 0.1;
  problem.stop = &interruption();
  if (request.file)
    problem.samples = request.file->times;
  else
    for (int k = 1; k <= request.chart.samples; ++k)
      problem.samples.push_back(problem.begin + (scene.run.options.end - problem.begin) * k / request.chart.samples);
  return problem;
}

/// Methods requested, or all methods of a quick or a full chart.
std::vector<ChartMethod> methods_of(const ChartCommandOptions &chart, int n_coordinates)
{
  const PeerChoice         peers = chart.peers ? PeerChoice::with : PeerChoice::without;
  std::vector<std::string> keys  = chart.methods;
  if (keys.empty() && chart.quick)
    keys = quick_methods(peers);
  std::vector<ChartMethod> methods = choose_methods(keys, peers, n_coordinates);
  for (ChartMethod &method : methods)
    if (method.peer && chart.native)
    {
      method.peer->vectors = peers::PeerVectors::native;
      method.name          = peers::peer_name(*method.peer);
    }
  return methods;
}

SignalSamples chart_model(const ChartRequest &request, const Scene &scene, WorkPrecision &chart, ProgressLine &progress)
{
  PreparedMachine prepared = prepare_machine(scene, progress.callback());
  if (prepared.companion && !prepared.in_modes)
    throw std::invalid_argument(scene.frame.place + ": the chart needs a small model; reduce the frame "
                                                    "(reduction.method = \"craig-bampton\")");
  progress.show("start");
  const coupling::InitialState initial = prepare_start(scene, prepared);

  const WorkProblem problem = problem_of(request, scene, prepared.machine, initial);
  const int         index   = int(chart.models.size());
  WorkModel         model;
  model.coordinates = prepared.machine.size();
  model.modes       = std::max(0, model_facts(prepared).modes);
  progress.show("reference");
  Reference reference = own_reference(problem, chart.notes);
  if (request.file)
    reference = compared(*request.file, problem.signals, reference);
  model.reference       = reference.how;
  model.reference_error = reference.error;
  model.reference_cpu_s = reference.cpu_s;
  chart.models.push_back(model);
  chart.n_samples = problem.samples.size();
  chart.begin     = problem.begin;
  chart.end       = problem.samples.back();
  chart.signals.clear();
  for (const coupling::Signal &signal : problem.signals)
    chart.signals.push_back(signal.name);

  const auto steps = ladder("--steps", request.chart.steps, kind::time, default_steps(scene, request.chart.quick));
  const auto tolerances =
      ladder("--tolerances", request.chart.tolerances, kind::number, default_tolerances(request.chart.quick));
  const std::vector<ChartMethod> methods = methods_of(request.chart, prepared.machine.size());
  const MotionScales             scales  = motion_scales(problem, reference.method, true);
  const SeriesRun                series(problem, reference.values, model, scales, longest_step(problem));
  const double                   n_series = double(methods.size() * request.events.size());
  double                         done     = 0.;
  for (const ChartMethod &method : methods)
    for (const bool events : request.events)
    {
      const auto tell = [&](const WorkPoint &point)
      { progress.show("chart: " + point.method + (events ? ", events" : ""), done / n_series); };
      series.run(method, events, index, method.controlled ? tolerances : steps, tell, chart.points);
      done += 1.;
    }
  return reference.values;
}

int make_chart(const CommonOptions &options, const ChartCommandOptions &chart_options)
{
  if (chart_options.reductions.requested)
  {
    ReductionChart reductions = chart_options.reductions;
    reductions.modes          = chart_options.modes;
    return chart_reductions(options, reductions);
  }
  const Variant file  = Variant::of_file(options.input, options.overrides, options.scripts);
  const Scene   scene = file.scene();
  require_run(scene);
  check_scene(scene);
  if (chart_options.samples < 2)
    throw std::invalid_argument("--samples: needs 2 or more, got " + std::to_string(chart_options.samples));
  if (!chart_options.modes.empty() && !scene.reduction.reduces())
    throw std::invalid_argument("--modes: " + options.input +
                                " does not reduce its frame, so there are no modes to choose; omit the option, or add "
                                "[reduction] to the scene");
  choose_methods(chart_options.methods, PeerChoice::with, 0);
  const std::filesystem::path folder = results_path(options, scene);
  const ResultsLock           held(folder);
  OwnFolder(folder).require_free(chart_files(), inputs_of(options, {chart_options.reference}));

  ChartRequest request{options, chart_options, {}, {}};
  if (!chart_options.reference.empty())
    request.file = ReferenceFile(chart_options.reference);
  if (chart_options.events != "off")
    request.events.push_back(true);
  if (chart_options.events != "on")
    request.events.push_back(false);

  WorkPrecision chart;
  chart.scene       = scene.name;
  chart.description = scene.description;
  chart.version     = version;
  chart.peers       = chart_options.peers ? peers::peer_version() : "";
  chart.targets     = ladder("--error", chart_options.errors, kind::number, {1e-2, 1e-3, 1e-5, 1e-7});
  if (const auto nearby = std::filesystem::path(chart_options.reference).parent_path();
      request.file && incomplete(nearby))
    chart.notes.push_back("--reference: " + incomplete_words(nearby));
  if (chart_options.peers && !peers::peers_available())
    chart.notes.push_back("this build has no SUNDIALS: general-purpose integrators are missing");

  ProgressLine               progress(options.quiet);
  std::vector<SignalSamples> references;
  if (chart_options.modes.empty())
    chart_model(request, scene, chart, progress);
  for (const int modes : chart_options.modes)
    references.push_back(
        chart_model(request, file.with("reduction.modes=" + std::to_string(modes)).scene(), chart, progress));
  for (std::size_t m = 0; m + 1 < references.size(); ++m)
    chart.models[m].truncation = scaled_error(references[m], references.back());
  progress.done();
  if (interruption())
  {
    chart.targets.clear();
    chart.notes.push_back("interrupted: not all methods and steps were run, so no fastest method is listed");
  }

  write_chart(folder, chart);
  std::cout << work_precision_text(chart) << "chart: " << (folder / "chart.html").string() << '\n';
  return interruption().load() ? exit_interrupted : exit_done;
}

} // namespace

Command chart_command()
{
  const auto own = std::make_shared<ChartCommandOptions>();
  return {
      "chart",
      "work-precision chart: error and CPU time of methods and settings",
      {"gestell chart apps/scenes/press_minimal.toml --quick -o results/chart"},
      CommandInput::scene,
      {{"--methods", &own->methods, "methods by name, such as bdf-2,exact*,cvode-5 (default: all)"},
       {"--steps", &own->steps, "fixed steps, such as \"40 us\",\"10 us\""},
       {"--tolerances", &own->tolerances, "tolerances of controlled steps, such as 1e-3,1e-5"},
       {"--error", &own->errors, "errors for which the fastest run is listed (default 1e-2,1e-3,1e-5,1e-7)"},
       {"--signals", &own->signals, "signals for the error (default: all of the scene)"},
       CommandOption{"--modes", &own->modes, "numbers of modes of the reduced frame, such as 10,20,50"}.above_zero(),
       CommandOption{"--reference", &own->reference, "table of the reference solution (CSV), instead of a fine run"}
           .existing_file(),
       CommandOption{"--events", &own->events, "on: located, off: detected after the step, both (default)"}.one_of(
           {"on", "off", "both"}),
       {"--peers,!--no-peers", &own->peers, "include general-purpose integrators (default)"},
       {"--native-vectors", &own->native, "general-purpose integrators with vector loops compiled for this processor"},
       {"--quick", &own->quick, "fewer methods, steps and tolerances: one minute instead of ten"},
       CommandOption{"--samples", &own->samples, "number of instants for the error (default 2000)"}.at_most(1e6),
       CommandOption{"--limit", &own->limit, "largest CPU time of one run [s] (default 20, with --quick 5)"}
           .above_zero(),
       {"--reductions", &own->reductions.requested,
        "compare reductions of the frame over numbers of modes, instead of integrators"},
       CommandOption{"--outputs", &own->reductions.outputs,
                     "outputs for the error of --reductions, such as F_P.max,F_P.min"}
           .with("--reductions"),
       CommandOption{"--full", &own->reductions.full, "full frame as the reference of --reductions (slow)"}.with(
           "--reductions")},
      [own](const CommonOptions &options) { return make_chart(options, *own); }};
}

} // namespace gestell::apps
