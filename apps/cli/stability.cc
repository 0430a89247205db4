#include "apps/analysis/result_folder.h"
#include "apps/atlas/atlas.h"
#include "apps/atlas/scene_stability.h"
#include "apps/cli/command.h"
#include "apps/cli/json_answer.h"
#include "apps/cli/progress.h"
#include "apps/cli/results_path.h"
#include "apps/output/describe/described_table.h"
#include "apps/output/folder/writing.h"
#include "apps/output/report/stability_report.h"
#include "apps/output/text/write_file.h"
#include "apps/session/prepared_machine.h"
#include "apps/version.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>

namespace gestell::apps
{

namespace
{

/// Only an atlas and its figures are replaced.
void require_atlas(const std::filesystem::path &file, const std::filesystem::path &figures)
{
  std::ifstream in(file);
  std::string   heading;
  std::getline(in, heading);
  const bool there = std::filesystem::exists(std::filesystem::symlink_status(file));
  if (there ? heading != "# Failure atlas" : std::filesystem::exists(std::filesystem::symlink_status(figures)))
    throw std::invalid_argument(
        "--atlas: " + (there ? file : figures).string() +
        " already exists and is not a failure atlas, so it is not replaced; choose another name");
}

/// Writes the failure atlas to `file` (Markdown) and its figures into a folder next to it; returns an ExitCode.
int write_atlas(const std::filesystem::path &file, bool quiet)
{
  const std::filesystem::path nearby  = file.parent_path().empty() ? "." : file.parent_path();
  const std::filesystem::path figures = nearby / file.stem();
  require_writable(nearby);
  require_atlas(file, figures);
  ProgressLine progress(quiet);
  progress.show("failure atlas");
  const std::vector<AtlasEntry> entries = failure_atlas();
  progress.done();

  std::filesystem::create_directories(figures);
  int failed = 0;
  for (const AtlasEntry &entry : entries)
  {
    for (const NamedSvg &figure : entry.figures)
      write_file(figures / (figure.name + ".svg"), figure.svg);
    for (const AtlasComparison &c : entry.comparisons)
      if (!(std::abs(c.measured - c.predicted) <= c.tolerance))
      {
        ++failed;
        std::cout << entry.title << ": " << c.what << ": predicted " << c.predicted << ", measured " << c.measured
                  << '\n';
      }
  }
  write_file(file, atlas_markdown(entries, file.stem().string()));
  std::cout << entries.size() << " cases of failing methods: " << file.string() << '\n';
  return failed == 0 ? exit_done : exit_failed;
}

struct StabilityCommandOptions
{
  std::vector<double> zetas = {0., 0.01, 0.05}; ///< damping ratios of the maps
  double              step  = 0.;               ///< [s] at which the scene's modes are shown; 0: run.step
  std::string         atlas;                    ///< file of the failure atlas; empty: none
};

void check_ratios(const std::vector<double> &zetas)
{
  for (const double zeta : zetas)
    if (!(zeta >= 0.) || zeta > 10.)
      throw std::invalid_argument("--zeta is " + short_text(zeta) + "; damping ratios must be between 0 and 10");
}

/// The scene's modes, its method and the others at its step.
void study_scene(const CommonOptions &options, double step, const Scene &scene,
                 const std::vector<MethodFamily> &families, StabilityStudy &study)
{
  ProgressLine    progress(options.quiet);
  PreparedMachine prepared = prepare_machine(scene, progress.callback());
  progress.show("modes");
  lay_methods_over(scene, prepared, step, families, study);
}

std::string ratio_name(double zeta)
{
  std::string text = std::to_string(zeta);
  text.erase(text.find_last_not_of('0') + 1);
  return text.back() == '.' ? text.substr(0, text.size() - 1) : text;
}

const std::vector<std::string> stability_files = {"stability_maps.csv", "unstable_intervals.csv", "stability_modes.csv",
                                                  "stability.html", "charts/"};

int map_stability(const CommonOptions &options, const StabilityCommandOptions &stability)
{
  if (!stability.atlas.empty())
    return write_atlas(stability.atlas, options.quiet);
  check_ratios(stability.zetas);

  const bool           with_scene = !options.input.empty();
  std::optional<Scene> scene;
  if (with_scene)
  {
    scene = read_scene(options.input, options.overrides, options.scripts);
    check_scene(*scene);
  }
  const std::filesystem::path folder =
      with_scene ? results_path(options, *scene)
                 : std::filesystem::path(options.folder.empty() ? "results/stability" : options.folder);
  const ResultsLock held(folder);
  OwnFolder(folder).require_free(stability_files,
                                 with_scene ? inputs_of(options) : std::vector<std::filesystem::path>());

  const std::vector<MethodFamily> families = method_families();
  StabilityStudy                  study;
  study.title   = with_scene ? scene->name + ": stability and accuracy of the integrators"
                             : "Stability and accuracy of the integrators";
  study.version = version;
  study.zetas   = stability.zetas;
  if (with_scene)
    study_scene(options, stability.step, *scene, families, study);
  const auto maps = stability_maps(families, study.zetas);
  study.intervals = unstable_maps(families, study.zetas);
  for (const double zeta : study.zetas)
    study.charts.emplace_back(zeta, stability_charts(families, maps, zeta, study.modes));

  write_or_rescue(folder,
                  [&](Writing &writing)
                  {
                    writing.write("stability_maps.csv", maps_csv(maps));
                    writing.write("unstable_intervals.csv",
                                  table_of(study.intervals)
                                      .renamed({{"from_omega_h", "unstable_from_omega_h"},
                                                {"growth_per_step", "largest_growth_per_step"}})
                                      .csv());
                    if (with_scene)
                      writing.write("stability_modes.csv",
                                    table_of(study.modes).renamed({{"modes_of", "kind"}, {"number", "mode"}}).csv());
                    for (const auto &[zeta, charts] : study.charts)
                      for (const NamedSvg &chart : charts)
                        writing.write("charts/stability-" + chart.name + "-" + ratio_name(zeta) + ".svg", chart.svg);
                    writing.write("stability.html", stability_page(study));
                  });

  if (answers_in_json())
    answer_with(stability_answer(study));
  std::cout << stability_text(study) << "maps: " << (folder / "stability.html").string() << '\n';
  return exit_done;
}

} // namespace

/// The scene may be left out.
Command stability_command()
{
  const auto own = std::make_shared<StabilityCommandOptions>();
  return {"stability",
          "stability and accuracy maps of the integrators, with the modes of a scene",
          {"gestell stability apps/scenes/press_minimal.toml --zeta 0,0.02"},
          CommandInput::scene_or_none,
          {{"--zeta", &own->zetas, "damping ratios of the maps (default 0,0.01,0.05)"},
           CommandOption{"--step", &own->step, "step [s] for the modes of the scene (default run.step)"}.above_zero(),
           {"--atlas", &own->atlas, "only write the failure atlas to this file (Markdown)"}},
          [own](const CommonOptions &options) { return map_stability(options, *own); }};
}

} // namespace gestell::apps
