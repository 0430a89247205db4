#include "apps/analysis/analyses.h"
#include "apps/analysis/result_folder.h"
#include "apps/cli/command.h"
#include "apps/cli/json_answer.h"
#include "apps/cli/modes_converge.h"
#include "apps/cli/progress.h"
#include "apps/cli/results_path.h"
#include "apps/output/folder/own_folder.h"
#include "apps/output/report/frame_text.h"
#include "apps/output/report/section.h"
#include "apps/output/tables/mode_tables.h"
#include "apps/output/tables/summary_json.h"
#include "apps/session/session.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <memory>
#include <optional>

namespace gestell::apps
{

namespace
{
void print_modes(const std::string &kind, const std::vector<coupling::Mode> &modes, const std::string &at_zero,
                 double limit)
{
  if (modes.empty())
    return;
  const bool refined = any_refined(modes);
  std::cout << kind << "\n  mode   frequency [Hz]" << (refined ? "     refined [Hz]" : "")
            << "   damping ratio   effective mass x / y / z [kg]\n";
  for (std::size_t j = 0; j < modes.size(); ++j)
  {
    const coupling::Mode &mode = modes[j];
    if (const std::string above = words_above(limit, j > 0 ? modes[j - 1].frequency_hz : 0., mode.frequency_hz);
        !above.empty())
      std::cout << "  " << above << '\n';
    std::cout << "  " << std::setw(4) << j + 1 << std::setprecision(8) << std::setw(17) << mode.frequency_hz;
    if (refined)
      std::cout << std::setw(17) << (std::isnan(mode.refined_hz) ? "unknown" : short_text(mode.refined_hz, 8));
    std::cout << std::setprecision(4) << std::setw(16)
              << (std::isnan(mode.damping_ratio) ? "-" : short_text(mode.damping_ratio)) << "   ";
    for (const double mass : mode.effective_mass)
      std::cout << std::setw(11) << mass;
    if (mode.growth > 0.)
      std::cout << "   unstable: grows at " << short_text(mode.growth, 3) << " 1/s, e-fold in "
                << short_text(1. / mode.growth, 3) << " s";
    else if (mode.frequency_hz == 0.)
      std::cout << "   " << at_zero;
    std::cout << '\n';
  }
  if (refined)
    std::cout << "  " << refined_words << '\n';
}

void print_poles(const std::vector<coupling::Pole> &poles)
{
  if (poles.empty())
    return;
  std::cout
      << "poles with drives and controllers, at the initial speeds\n  damped frequency [Hz]   damping ratio       "
         "real part [1/s]   dominant DOF\n";
  for (const coupling::Pole &pole : poles)
    std::cout << std::setw(23) << (pole.vibrates() ? short_text(pole.frequency_hz(), 6) : "-") << std::setw(16)
              << (pole.vibrates() ? short_text(pole.damping_ratio()) : "-") << std::setw(22)
              << short_text(pole.s.real(), 6) << "   " << pole.moves << (pole.s.real() > 0. ? "   unstable" : "")
              << '\n';
}

void print_energies(const Result &result)
{
  if (!result.energy_shares)
    return;
  std::cout << "energy of the coupled modes\n  mode   strain | kinetic\n";
  for (std::size_t j = 0; j < result.coupled_modes.size(); ++j)
    std::cout << "  " << std::setw(4) << j + 1 << "   " << strain_text(*result.energy_shares, j) << " | "
              << kinetic_text(*result.energy_shares, j) << '\n';
}

/// Whether only the frame moves: its modes are those of the machine.
bool same_modes(const std::vector<coupling::Mode> &one, const std::vector<coupling::Mode> &other)
{
  return std::equal(one.begin(), one.end(), other.begin(), other.end(),
                    [](const coupling::Mode &a, const coupling::Mode &b)
                    { return std::abs(a.frequency_hz - b.frequency_hz) <= 1e-9 * b.frequency_hz; });
}

void print_coupled_modes(const Result &result)
{
  if (!result.coupled_modes.empty() && same_modes(result.frame_modes, result.coupled_modes))
  {
    std::cout << "coupled machine: same modes as the frame alone\n";
    return;
  }
  print_modes("coupled machine", result.coupled_modes, "rigid-body mode: no stiffness", result.model.frequency_limit);
  print_energies(result);
}

void print_answer(const Result &result, const std::optional<coupling::MeshConvergence> &convergence, double tolerance)
{
  for (const std::string &line : frame_text(result.model))
    std::cout << "frame: " << line << '\n';
  if (convergence)
    print_convergence(*convergence, tolerance);
  print_modes("frame as supported, interface free", result.frame_modes, "rigid-body mode",
              result.model.frequency_limit);
  print_coupled_modes(result);
  print_poles(result.poles);
  std::cout << answers_text(result);
}

int find_modes(const CommonOptions &options, bool geometric, const ConvergeOptions &mesh, const Analyses &more)
{
  ProgressLine progress(options.quiet);
  Session      session(options.input, options.overrides, options.scripts, {progress.callback()});
  session.check();
  const std::filesystem::path folder = results_path(options, session.scene());
  const ResultsLock           held(folder);
  const auto                  inputs = inputs_of(options, files_read_by(more));
  require_room(folder, {mesh.converge > 0. ? "mesh_convergence.csv" : ""}, inputs);
  check_all(more, session);

  std::optional<coupling::MeshConvergence> convergence;
  if (mesh.converge > 0.)
  {
    convergence = converge_frame(session.scene(), mesh, folder, session.progress());
    session.use_frame(convergence->frame);
  }
  Result result =
      session.modes(geometric ? coupling::GeometricStiffness::included : coupling::GeometricStiffness::left_out);
  const AnalysisOutcome outcome = add_answers(more, session, result);
  if (convergence)
    for (const std::string &warning : convergence_warnings(*convergence, mesh.converge))
      result.warnings.push_back(warning);
  progress.done();
  const bool beside_a_run = OwnFolder(folder).owns("history.csv");
  if (beside_a_run && incomplete(folder))
    result.warnings.push_back(incomplete_words(folder));
  if (beside_a_run)
    write_modes(folder, result);
  else
  {
    prepare_folder(folder, inputs);
    write_results(folder, result);
  }

  if (convergence)
    write_convergence(folder, *convergence);
  if (answers_in_json())
    answer_with(summary_json(result));
  print_answer(result, convergence, mesh.converge);
  for (const std::string &warning : result.warnings)
    std::cerr << "gestell: warning: " << warning << '\n';
  if (beside_a_run)
    std::cout
        << folder.string()
        << " contains a run, which is kept: only tables of modes, their charts and frame_modes.pvd were written\n";
  else
    std::cout << "report: " << (folder / "report.html").string() << '\n';
  return outcome == AnalysisOutcome::interrupted                                          ? exit_interrupted
         : outcome == AnalysisOutcome::failed || (convergence && !convergence->converged) ? exit_failed
                                                                                          : exit_done;
}

} // namespace

Command modes_command()
{
  const auto                 geometric = std::make_shared<std::string>("on");
  const auto                 mesh      = std::make_shared<ConvergeOptions>();
  const auto                 more      = analyses_of("modes");
  std::vector<CommandOption> options   = {
        CommandOption{"--converge", &mesh->converge,
                    "refine the mesh of the frame until frequencies and compliances are within this relative error, "
                      "such as 0.01; print error and uncertainty"}
            .above_zero(),
        CommandOption{"--frequencies", &mesh->frequencies, "number of elastic frequencies that must converge (default 4)"}
            .above_zero()
            .with("--converge"),
        CommandOption{"--watch", &mesh->watch, "quantities that must converge: all (default), or frequencies"}
            .one_of({"all", "frequencies"})
            .with("--converge"),
        CommandOption{"--max-coordinates", &mesh->max_coordinates, "largest number of DOFs of a mesh (default 1000000)"}
            .above_zero()
            .with("--converge"),
        CommandOption{"--geometric", geometric.get(), "on (default) or off: geometric stiffness of rotating forces"}
            .one_of({"on", "off"})};
  add_options(more, options);
  return {"modes",
          "natural frequencies and mode shapes of the frame and of the coupled machine",
          {"gestell modes apps/scenes/press_minimal.toml", "gestell modes apps/scenes/press_minimal.toml --along crank",
           "gestell modes apps/scenes/press.toml --compare apps/scenes/press_minimal.toml"},
          CommandInput::scene,
          options,
          [geometric, mesh, more](const CommonOptions &common)
          { return find_modes(common, *geometric == "on", *mesh, more); }};
}

} // namespace gestell::apps
