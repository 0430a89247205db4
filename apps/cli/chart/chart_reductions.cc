#include "apps/cli/chart/chart_reductions.h"

#include "apps/analysis/result_folder.h"
#include "apps/cli/interruption.h"
#include "apps/cli/results_path.h"
#include "apps/output/charts/chart.h"
#include "apps/output/folder/writing.h"
#include "apps/output/text/csv.h"
#include "apps/session/session.h"
#include "apps/sizing/error_budget.h"
#include "apps/sizing/reduction_comparison.h"
#include "fem/values/number_text.h"

#include <filesystem>
#include <iomanip>
#include <iostream>

namespace gestell::apps
{

namespace
{

void print_point(const ReductionPoint &point)
{
  std::cout << "  " << std::left << std::setw(16) << point.method << std::right << std::setw(7) << point.modes;
  if (!point.failure.empty())
    std::cout << "  " << point.failure;
  else
    std::cout << std::setw(13) << point.coordinates << std::setw(17) << short_text(point.prepare_cpu, 3)
              << std::setw(13) << short_text(point.run_cpu, 3) << "  "
              << (point.worst.empty() ? "reference" : short_text(point.error, 3) + ", " + point.worst);
  std::cout << std::endl;
}

CsvTable csv_of(const ReductionComparison &comparison)
{
  std::vector<std::string> heads{"method",      "modes", "coordinates", "prepare cpu [s]",
                                 "run cpu [s]", "error", "worst",       "failure"};
  for (const OutputName &output : comparison.outputs)
    heads.push_back(output.text);
  CsvTable   csv(heads);
  const auto add = [&](const ReductionPoint &point)
  {
    const auto known = [&](auto x) { return point.failure.empty() ? std::optional(x) : std::nullopt; };
    std::vector<std::optional<double>> values(point.values.begin(), point.values.end());
    values.resize(comparison.outputs.size());
    csv.add(point.method, point.modes, known(point.coordinates), known(point.prepare_cpu), known(point.run_cpu),
            known(point.error), point.worst, point.failure, values);
  };
  add(comparison.reference);
  for (const ReductionPoint &point : comparison.points)
    add(point);
  return csv;
}

/// Error over `what` of a point, a line for each method.
template <typename What>
std::string svg_of(const ReductionComparison &comparison, const std::string &title, const std::string &label,
                   const What &what)
{
  Chart chart{title};
  chart.x.scale = chart.y.scale = Scale::logarithmic;
  chart.x.label                 = label;
  chart.y.label                 = "largest error of the outputs";
  std::vector<Curve> curves;
  for (const ReductionPoint &point : comparison.points)
  {
    if (!point.failure.empty() || !(point.error > 0.))
      continue;
    if (curves.empty() || curves.back().name != point.method)
    {
      curves.push_back({point.method});
      curves.back().colour = int(curves.size()) - 1;
      curves.back().marker = Marker::ring;
    }
    curves.back().add(what(point), point.error);
    curves.back().notes.push_back({std::to_string(point.modes) + " modes; " + point.worst});
  }
  chart.panels[0].curves = curves;
  return curves.empty() ? "" : chart_svg(chart);
}

void write_comparison(const ReductionComparison &comparison, const std::string &scene, Writing &writing)
{
  const auto write = [&](const std::string &name, const std::string &svg)
  {
    if (!svg.empty())
      writing.write("charts/" + name, svg);
  };
  writing.write("reductions.csv", csv_of(comparison));
  write("reductions_cpu.svg", svg_of(comparison, "Reductions: " + scene, "CPU time of the run [s]",
                                     [](const ReductionPoint &point) { return point.run_cpu; }));
  write("reductions_coordinates.svg", svg_of(comparison, "Reductions: " + scene, "DOFs of the frame",
                                             [](const ReductionPoint &point) { return double(point.coordinates); }));
}

} // namespace

int chart_reductions(const CommonOptions &options, const ReductionChart &requested)
{
  Session session(options.input, options.overrides, options.scripts);
  session.check_run();
  const Scene                &scene   = session.scene();
  const auto                  outputs = budget_outputs(scene, requested.outputs);
  const std::filesystem::path folder  = results_path(options, scene);
  const ResultsLock           held(folder);
  OwnFolder(folder).require_free({"reductions.csv", "charts/"}, inputs_of(options));
  ComparisonOptions how;
  how.full     = requested.full;
  how.on_point = print_point;
  how.stop     = &interruption();
  how.modes    = requested.modes;
  std::cout << "  reduction         modes         DOFs  prepare [CPU s]  run [CPU s]  largest error, of which output\n";
  const ReductionComparison comparison = compare_reductions(scene, outputs, how);
  OwnFolder(folder).remove_all([](const std::string &name) { return has_form(name, "charts/reductions_*"); });
  write_or_rescue(folder, [&](Writing &writing) { write_comparison(comparison, scene.name, writing); });
  std::cout << "table: " << (folder / "reductions.csv").string()
            << "\nchart: " << (folder / "charts" / "reductions_cpu.svg").string() << '\n';
  return interruption().load() ? exit_interrupted : exit_done;
}

} // namespace gestell::apps
