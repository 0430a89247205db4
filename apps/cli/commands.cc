#include "apps/cli/commands.h"

#include "apps/analysis/analyses.h"
#include "apps/cli/analysis_command.h"

namespace gestell::apps
{

Command run_command(), modes_command(), reduce_command(), check_command(), chart_command(), mesh_command(),
    stability_command(), periodic_command(), export_command(), size_command(), study_command(), show_command(),
    new_command(), verify_command(), help_command();

std::vector<Command> commands()
{
  std::vector<Command> all = {run_command(),    modes_command(),  reduce_command(),    check_command(),
                              chart_command(),  mesh_command(),   stability_command(), periodic_command(),
                              export_command(), size_command(),   study_command(),     show_command(),
                              new_command(),    verify_command(), help_command()};
  for (const AnalysisEntry &entry : analyses())
    if (entry.of.empty())
      all.push_back(analysis_command(entry));
  return all;
}

} // namespace gestell::apps
