#include "apps/analysis/result_files.h"

#include "apps/analysis/analyses.h"
#include "apps/output/folder/own_folder.h"
#include "apps/output/tables/basins_table.h"
#include "apps/output/tables/energy_table.h"
#include "apps/output/tables/modes_along_table.h"
#include "apps/output/tables/periodic_tables.h"
#include "apps/output/tables/result_tables.h"
#include "apps/output/tables/section_table.h"
#include "apps/output/tables/sensitivity_table.h"
#include "apps/output/tables/size_table.h"
#include "apps/output/values/result.h"

#include <algorithm>

namespace gestell::apps
{
namespace
{

std::string history(const Result &result)
{
  return result.run && !result.run->columns.empty() ? history_csv(*result.run) : "";
}

std::string modes(const Result &result)
{
  return result.frame_modes.empty() && result.coupled_modes.empty() ? "" : modes_csv(result);
}

std::string mode_energies(const Result &result)
{
  return result.energy_shares ? mode_energies_csv(result) : "";
}

std::string along(const Result &result)
{
  return result.along ? modes_along_csv(*result.along) : "";
}

std::string along_shapes(const Result &result)
{
  return result.along ? modes_along_shapes_csv(*result.along, result.coordinate_names) : "";
}

std::string solutions(const Result &result)
{
  return result.periodic ? solutions_csv(*result.periodic) : "";
}

std::string multipliers(const Result &result)
{
  return result.periodic ? multipliers_csv(*result.periodic) : "";
}

std::string special_points(const Result &result)
{
  return result.periodic ? special_points_csv(*result.periodic) : "";
}

std::string basins_of_motions(const Result &result)
{
  return result.periodic ? basins_csv(*result.periodic) : "";
}

std::string section_of_motion(const Result &result)
{
  return result.periodic ? section_csv(*result.periodic) : "";
}

std::vector<std::pair<std::string, std::string>> orbits(const Result &result)
{
  return result.periodic ? orbit_files(*result.periodic) : std::vector<std::pair<std::string, std::string>>();
}

std::string sensitivities(const Result &result)
{
  return result.sensitivities && result.sensitivities->failure.empty() ? sensitivities_csv(*result.sensitivities) : "";
}

std::string models(const Result &result)
{
  return result.size ? size_csv(*result.size) : "";
}

/// Of what is no analysis.
const std::vector<ResultFile> own_files = {
    {"history.csv", "to plot: every signal over time", history},
    {"modes.csv", "natural frequencies, damping, effective masses", modes},
    {"mode_energies.csv", "where the strain and kinetic energy of each coupled mode lies", mode_energies},
    {"modes_along.csv", "frequencies and damping at each position, with `modes --along`", along},
    {"modes_along_shapes.csv", "the shapes to them", along_shapes},
    {"solutions.csv", "periodic motions with their stability and signals, of `periodic`", solutions},
    {"multipliers.csv", "their Floquet multipliers", multipliers},
    {"special_points.csv", "where they begin, end or change, with `periodic --along`", special_points},
    {"orbit_*.csv", "one period of all signals, by the number of the solution", nullptr, "", "", orbits},
    {"section.csv", "a motion at the begin of every period, where `periodic` follows it for long", section_of_motion},
    {"basins.csv", "which start settles to which motion, with `periodic --basins`", basins_of_motions},
    {"sensitivities.csv", "derivatives of peaks, instants, events and frequencies, with `run --sensitivities`",
     sensitivities},
    {"size.csv", "models that `size` tried, with their cost and errors", models},
    {"sized.toml", "the one that it chose, as a scene", nullptr, "", "", nullptr, WrittenBy::its_command},
    {"mesh_convergence.csv", "meshes, limits and errors, with `modes --converge`", nullptr, "", "", nullptr,
     WrittenBy::its_command},
    {"frame_modes.pvd", "mode shapes of the frame in ParaView", nullptr, "frame_modes", ".vtp"},
    {"coupled_modes.pvd", "mode shapes of frame and mechanism together in ParaView", nullptr, "coupled_modes", ".vtp"},
    {"motion.pvd", "frame and mechanism in motion in ParaView", nullptr, "motion", ".vtp"},
    {"forces.pvd", "what elements, joints, springs and loads exert on each body, as vectors where they act", nullptr,
     "forces", ".vtp"},
    {"view.py", "opens motion.pvd and forces.pvd in ParaView, deformed, coloured, at the main peak"},
    {"stress.pvd", "stresses at the frame's skin in ParaView, with `[output.stress]`", nullptr, "stress", ".vtp"},
    {"report.html",
     "to read: one page, opens without a network, light or dark, printable; its pictures, each for itself", nullptr,
     "charts", ".svg"},
    {"summary.json", "to compare and to process: peaks, events, frequencies, work, energy, warnings"}};

} // namespace

const std::vector<ResultFile> &result_files()
{
  static const std::vector<ResultFile> files = []
  {
    std::vector<ResultFile> all = own_files;
    for (const AnalysisEntry &entry : analyses())
      all.insert(all.end(), entry.files.begin(), entry.files.end());
    return all;
  }();
  return files;
}

std::vector<std::string> result_names()
{
  std::vector<std::string> names;
  for (const ResultFile &file : result_files())
    if (file.by == WrittenBy::write_results)
    {
      names.push_back(file.name);
      if (!file.folder.empty())
        names.push_back(file.folder + '/');
    }
  return names;
}

bool is_result(const std::string &name)
{
  return std::any_of(result_files().begin(), result_files().end(),
                     [&](const ResultFile &file) {
                       return has_form(name, file.name) ||
                              (!file.folder.empty() && has_form(name, file.folder + "/*" + file.ending));
                     });
}

std::string result_files_table()
{
  std::string text = "| file | what it is for |\n|---|---|\n";
  for (const ResultFile &file : result_files())
    text += "| `" + file.name + "`" + (file.folder.empty() ? "" : ", `" + file.folder + "/*" + file.ending + "`") +
            " | " + file.holds + " |\n";
  return text + "\n";
}

} // namespace gestell::apps
