#include "apps/cli/commands.h"

namespace gestell::apps
{

Command run_command(), modes_command(), reduce_command(), check_command(), chart_command(), mesh_command(),
    stability_command(), periodic_command(), frf_command(), export_command(), size_command(), study_command(),
    show_command(), new_command(), verify_command(), help_command();

std::vector<Command> commands()
{
  return {run_command(),       modes_command(),    reduce_command(), check_command(),  chart_command(), mesh_command(),
          stability_command(), periodic_command(), frf_command(),    export_command(), size_command(),  study_command(),
          show_command(),      new_command(),      verify_command(), help_command()};
}

} // namespace gestell::apps
