#include "apps/analysis/result_files.h"

#include "apps/analysis/analyses.h"
#include "apps/output/folder/own_folder.h"
#include "apps/output/tables/mode_tables.h"
#include "apps/output/tables/result_tables.h"
#include "apps/output/tables/size_table.h"
#include "apps/output/values/result.h"

#include <algorithm>

namespace gestell::apps
{
namespace
{

/// The content of a file of a part that a result may have; "" without it.
template <auto part, auto table>
std::string csv_of(const Result &result)
{
  return result.*part ? std::string(table(*(result.*part))) : "";
}
template <auto table>
std::string csv_of(const Result &result)
{
  return table(result);
}

/// Files that do not belong to an analysis.
const std::vector<ResultFile> own_files = {
    {"history.csv", "every signal over time, for plots", csv_of<&Result::run, history_csv>},
    {"modes.csv", "natural frequencies, damping, effective masses", csv_of<modes_csv>},
    {"mode_energies.csv", "strain and kinetic energy of each coupled mode by part", csv_of<mode_energies_csv>},
    {"size.csv", "models examined by `size`, with cost and errors", csv_of<&Result::size, size_csv>},
    {"sized.toml", "the model chosen by `size`, as a scene", nullptr, "", "", nullptr, WrittenBy::its_command},
    {"mesh_convergence.csv", "meshes, limits and errors, with `modes --converge`", nullptr, "", "", nullptr,
     WrittenBy::its_command},
    {"frame_modes.pvd", "mode shapes of the frame in ParaView", nullptr, "frame_modes", ".vtp"},
    {"coupled_modes.pvd", "mode shapes of frame and mechanism together in ParaView, by `modes`", nullptr,
     "coupled_modes", ".vtp"},
    {"motion.pvd", "frame and mechanism in motion in ParaView", nullptr, "motion", ".vtp"},
    {"forces.pvd", "forces of elements, joints, springs and loads on each body, for arrows in ParaView", nullptr,
     "forces", ".vtp"},
    {"names.pvd", "names of the bodies as text in ParaView, at points that move with them", nullptr, "names", ".vtp"},
    {"view.py",
     "macro that opens motion.pvd, forces.pvd and names.pvd in ParaView at the main peak, deformed and coloured"},
    {"stress.pvd", "stresses at the skin of the frame in ParaView, with `[output.stress]`", nullptr, "stress", ".vtp"},
    {"report.html", "report as one page for browser or print, usable offline; its charts as files", nullptr, "charts",
     ".svg"},
    {"summary.json", "results for other programs: peaks, events, frequencies, work, energy, warnings"}};

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
  std::string text = "| File | Content |\n|---|---|\n";
  for (const ResultFile &file : result_files())
    text += "| `" + file.name + "`" + (file.folder.empty() ? "" : ", `" + file.folder + "/*" + file.ending + "`") +
            " | " + file.holds + " |\n";
  return text + "\n";
}

} // namespace gestell::apps
