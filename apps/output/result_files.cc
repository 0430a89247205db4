#include "apps/output/result_files.h"

#include "apps/output/tables/modes_along_table.h"
#include "apps/output/tables/result_tables.h"

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

std::string along(const Result &result)
{
  return result.along ? modes_along_csv(*result.along) : "";
}

std::string along_shapes(const Result &result)
{
  return result.along ? modes_along_shapes_csv(*result.along, result.coordinate_names) : "";
}

} // namespace

const std::vector<ResultFile> &result_files()
{
  static const std::vector<ResultFile> files = {
      {"history.csv", "to plot: every signal over time", history},
      {"modes.csv", "natural frequencies, damping, effective masses", modes},
      {"modes_along.csv", "frequencies and damping at each position, with `modes --along`", along},
      {"modes_along_shapes.csv", "the shapes to them", along_shapes},
      {"mesh_convergence.csv", "meshes, limits and errors, with `modes --converge`"},
      {"frame_modes.pvd", "mode shapes of the frame in ParaView", nullptr, "frame_modes", ".vtp"},
      {"motion.pvd", "frame and mechanism in motion in ParaView", nullptr, "motion", ".vtp"},
      {"stress.pvd", "stresses at the frame's skin in ParaView, with `[output.stress]`", nullptr, "stress", ".vtp"},
      {"report.html",
       "to read: one page, opens without a network, light or dark, printable; its pictures, each for itself", nullptr,
       "charts", ".svg"},
      {"summary.json", "to compare and to process: peaks, events, frequencies, work, energy, warnings"}};
  return files;
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
