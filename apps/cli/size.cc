#include "apps/analysis/analyses.h"
#include "apps/analysis/budget/budget.h"
#include "apps/analysis/result_folder.h"
#include "apps/cli/command.h"
#include "apps/cli/interruption.h"
#include "apps/cli/json_answer.h"
#include "apps/cli/progress.h"
#include "apps/cli/results_path.h"
#include "apps/output/folder/own_folder.h"
#include "apps/output/tables/size_table.h"
#include "apps/output/tables/summary_json.h"
#include "apps/session/session.h"
#include "apps/sizing/size_search.h"
#include "apps/sizing/sized_scene.h"
#include "coupling/frame/frame_cache.h"

#include <iostream>
#include <memory>
#include <stdexcept>
#include <utility>

namespace gestell::apps
{

namespace
{

struct SizeCommand
{
  double      tolerance = 0.;
  std::string outputs;
  double      max_cpu = 0., max_memory_gb = 0.;
  bool        exhaustive = false;
};

const char *const sized_name = "sized.toml";
const char *const all_name   = "size_all.csv";

SizedModel found(const Scene &scene, const std::vector<OutputName> &outputs, const SizeCommand &requested)
{
  SizeOptions options;
  options.tolerance   = requested.tolerance;
  options.max_cpu     = requested.max_cpu;
  options.max_memory  = 1e9 * requested.max_memory_gb;
  options.stop        = &interruption();
  options.exhaustive  = requested.exhaustive;
  options.on_forecast = [](const SizeForecast &forecast) { std::cout << forecast_text(forecast) << std::endl; };
  options.on_rung     = [begins = true](const SizeRung &rung) mutable
  {
    if (std::exchange(begins, false))
      std::cout << "  elements [m]         DOFs  modes  method                CPU [s]  error/allowed, largest from\n";
    std::cout << rung_text(rung) << std::endl;
  };
  return size_search(scene, outputs, options);
}

int size_scene(const CommonOptions &options, const SizeCommand &requested)
{
  if (requested.tolerance == 0.)
    throw std::invalid_argument("--tolerance is missing; give the allowed relative error of each output, such as 0.01");
  Session session(options.input, options.overrides, options.scripts);
  session.check_run();
  const Scene                &scene   = session.scene();
  const auto                  outputs = budget_outputs(scene, requested.outputs);
  const std::filesystem::path folder  = results_path(options, scene);
  const ResultsLock           held(folder);
  require_room(folder, {sized_name, all_name}, inputs_of(options));
  say_run_is_replaced(folder, sized_name);
  SizedModel model = found(scene, outputs, requested);

  prepare_folder(folder);
  const std::filesystem::path file = folder / sized_name;
  OwnFolder(folder).write(sized_name, sized_scene(scene, options.overrides, model.chosen, folder));
  const double begin = coupling::cpu_time_without_cache();
  Session      sized(file.string(), {}, options.scripts, {{}, &interruption()});
  Result       result = complete_run(sized);
  model.result.cpu_s += coupling::cpu_time_without_cache() - begin;
  result.command       = "size";
  result.size          = model.result;
  const SizeRung &rung = model.result.ladder[model.result.chosen];
  ErrorBudget     budget;
  budget.entries   = rung.entries;
  budget.run_cpu_s = rung.cpu_s;
  result.answers.push_back(budget_answer(std::move(budget)));
  if (!model.result.met)
    result.warnings.push_back("no model keeps all outputs within the tolerance: " + model.result.stopped);
  if (requested.exhaustive && model.result.all.empty())
    result.warnings.push_back(
        "--exhaustive: models are compared with the finer model of the verification, and there is none: " +
        model.result.finer);
  write_results(folder, result);
  if (!model.result.all.empty())
    OwnFolder(folder).write(all_name, size_all_csv(model.result));
  OwnFolder(folder).write(sized_name, sized_scene(scene, options.overrides, model.chosen, folder));

  if (answers_in_json())
    answer_with(summary_json(result));
  std::cout << size_text(model.result) << "scene: " << file.string()
            << "\nreport: " << (folder / "report.html").string() << '\n';
  for (const std::string &warning : all_warnings(result))
    std::cerr << "gestell: warning: " << warning << '\n';
  if (result.run->interrupted)
    return exit_interrupted;
  return model.result.met && result.run->failure.empty() ? exit_done : exit_failed;
}

} // namespace

Command size_command()
{
  const auto requested = std::make_shared<SizeCommand>();
  return {"size",
          "find the cheapest adequate model: mesh, modes and time integration for a tolerance of the outputs",
          {"gestell size apps/scenes/press.toml --tolerance 0.01 --outputs F_P.max,F_P.min"},
          CommandInput::scene,
          {{"--tolerance", &requested->tolerance, "tolerated relative error of each output, 1e-8 to 1 (required)",
            CommandOption::Range::above_zero},
           {"--outputs", &requested->outputs,
            "outputs, such as F.max,F.min,x.t_max,modes.2 (default: largest and smallest value of every signal)"},
           {"--max-cpu", &requested->max_cpu, "largest CPU time [s] of a model, from CAD to the end of the run",
            CommandOption::Range::above_zero},
           {"--exhaustive", &requested->exhaustive,
            "also run every model up to one level finer than the chosen one, to verify the search"},
           {"--max-memory", &requested->max_memory_gb, "largest memory of the program [GB]",
            CommandOption::Range::above_zero}},
          [requested](const CommonOptions &options) { return size_scene(options, *requested); }};
}

} // namespace gestell::apps
