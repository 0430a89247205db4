#include "apps/cli/command.h"
#include "apps/cli/json_answer.h"
#include "apps/cli/progress.h"
#include "apps/cli/results_path.h"
#include "apps/output/exchange/state_space_files.h"
#include "apps/output/folder/own_folder.h"
#include "apps/output/result_folder.h"
#include "apps/output/tables/summary_json.h"
#include "apps/session/exchange/state_space_answer.h"
#include "apps/session/session.h"
#include "fem/values/nearest_name.h"
#include "fem/values/number_text.h"

#include <cmath>
#include <iomanip>
#include <iostream>
#include <memory>

namespace gestell::apps
{

namespace
{

void print_pair(const ResponsePair &pair)
{
  std::cout << pair.name() << " [" << pair.unit << "]\n";
  if (pair.peaks.empty())
    std::cout << "  no peak in this band\n";
  else
    std::cout << "   peak at [Hz]        amplitude   damping ratio by half-power width\n";
  for (const coupling::ResponsePeak &peak : pair.peaks)
    std::cout << std::setw(15) << short_text(peak.frequency_hz, 7) << std::setw(17)
              << (std::isfinite(peak.amplitude) ? short_text(peak.amplitude, 5) : "infinite") << std::setw(16)
              << (std::isfinite(peak.damping_ratio) ? short_text(peak.damping_ratio) : "-") << '\n';
}

void print_response(const FrequencyResponse &response)
{
  std::cout << response.kind << " of the machine linearised "
            << (response.at == "start"         ? "at the start of the scene"
                : response.at == "equilibrium" ? "in equilibrium"
                                               : "in the position of its modes")
            << (response.moves ? ", in motion" : ", at rest") << '\n';
  for (const auto &[state, names] : {std::pair("closed", &response.closed_contacts), {"open", &response.open_contacts}})
    if (!names->empty())
      std::cout << state << ": " << listed(*names) << '\n';
  for (const ResponsePair &pair : response.pairs)
    print_pair(pair);
}

/// Files of the linear machine, for other programs.
void export_machine(Session &session, const FrfOptions &requested, const std::string &format,
                    const std::filesystem::path &folder)
{
  const auto model = state_space_of(session.scene(), session.machine(), requested);
  OwnFolder  own(folder);
  const auto files = write_state_space(own, model, format);
  std::cout << "state space: " << model.states.size() << " states, " << model.inputs.size() << " inputs, "
            << model.outputs.size() << " outputs: " << (folder / files.front()).string()
            << (files.size() > 1 ? " ..." : "") << '\n';
}

/// Of measured curves, FILE or NAME=FILE.
std::vector<std::string> files_of(const std::vector<std::string> &measured)
{
  std::vector<std::string> files;
  for (const std::string &text : measured)
    files.insert(files.end(), {text, text.substr(text.find('=') + 1)});
  return files;
}

int find_response(const CommonOptions &options, const FrfOptions &requested, const std::string &format)
{
  ProgressLine progress(options.quiet);
  Session      session(options.input, options.overrides, options.scripts, {progress.callback()});
  session.check();
  const std::filesystem::path folder = results_path(options, session.scene());
  const ResultsLock           held(folder);
  const auto                  inputs = inputs_of(options, files_of(requested.measured));
  require_room(folder, format.empty() ? std::vector<std::string>() : state_space_files(format), inputs);
  const Result result = session.frequency_response(requested);
  progress.done();
  const bool beside_a_run = OwnFolder(folder).owns("history.csv");
  if (beside_a_run)
    write_modes(folder, result);
  else
  {
    prepare_folder(folder, inputs);
    write_results(folder, result);
  }
  if (answers_in_json())
    answer_with(summary_json(result));
  print_response(*result.frf);
  if (!format.empty())
    export_machine(session, requested, format, folder);
  for (const std::string &warning : result.warnings)
    std::cerr << "gestell: warning: " << warning << '\n';
  if (beside_a_run)
    std::cout << folder.string() << " holds a run, which is kept: only frf.csv, tables of modes, their charts and "
              << "frame_modes.pvd were written\n";
  else
    std::cout << "report: " << (folder / "report.html").string() << '\n';
  return exit_done;
}

} // namespace

Command frf_command()
{
  const auto own    = std::make_shared<FrfOptions>();
  const auto format = std::make_shared<std::string>();
  return {
      "frf",
      "frequency responses of the machine linearised at an operating point",
      {"gestell frf apps/scenes/press_minimal.toml --from frame.crown.uz --to frame.crown.uz,F_P"},
      CommandInput::scene,
      {{"--from", &own->from, "where unit forces act: displacements or angles, such as frame.crown.uz, slide, tip.ux"},
       {"--to", &own->to, "what answers: signals of the scene or paths, such as frame.table.uz, rod.force"},
       CommandOption{"--kind", &own->kind, "of displacements: receptance (default), mobility or accelerance"}.one_of(
           {"receptance", "mobility", "accelerance"}),
       CommandOption{"--at", &own->at,
                     "operating point: start (default) of the scene, equilibrium or undeformed at [modes]"}
           .one_of({"start", "equilibrium", "undeformed"}),
       {"--lowest", &own->lowest, "frequency, such as \"1 Hz\" (default: a quarter of the lowest mode)"},
       {"--highest", &own->highest, "frequency (default: 1.5 times the highest mode that is listed)"},
       CommandOption{"--points", &own->points, "frequencies, beside those that peaks ask for (default 400)"}
           .above_zero()
           .at_most(1e6),
       CommandOption{"--spacing", &own->spacing, "of the frequencies: log (default) or linear"}.one_of(
           {"log", "linear"}),
       {"--measured", &own->measured, "measured curves: FILE.csv, FILE.uff, or PAIR=FILE"},
       CommandOption{"--export", format.get(),
                     "the linear machine itself, x' = A x + B u, y = C x + D u, for other programs"}
           .one_of(exchange_formats())},
      [own, format](const CommonOptions &options) { return find_response(options, *own, *format); }};
}

} // namespace gestell::apps
