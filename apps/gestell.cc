// The program gestell: one executable with subcommands.

#include "apps/cli/commands.h"
#include "apps/cli/interruption.h"
#include "apps/cli/team.h"
#include "apps/command_line/command_line.h"
#include "apps/command_line/completion.h"
#include "apps/command_line/man_page.h"

#include <cstdlib>
#include <iostream>
#include <new>

namespace
{

using namespace gestell::apps;
namespace coupling = gestell::coupling;

int print(const std::string &text)
{
  std::cout << text;
  return exit_done;
}

int run_program(int argc, char **argv)
{
  CommonOptions                   options;
  const std::vector<Command>      all     = commands();
  const std::unique_ptr<CLI::App> line    = command_line(all, options);
  CLI::App                       &program = *line;
  if (argc == 3 && argv[1] == std::string("--completion"))
    return print(completion(program, all, argv[2]));
  if (argc == 2 && argv[1] == std::string("--man"))
    return print(man_page(program, all));
  if (argc > 1)
    require_command(program, argv[1]);
  try
  {
    program.parse(argc, argv);
  }
  catch (const CLI::ExtrasError &)
  {
    throw unexpected(program);
  }
  catch (const CLI::ParseError &error)
  {
    return program.exit(error) == 0 ? exit_done : exit_wrong_input;
  }

  if (options.jobs > 1)
    setenv("OPENBLAS_NUM_THREADS", std::to_string(options.jobs).c_str(), 1);
  for (const Command &command : all)
    if (program.get_subcommand(command.name)->parsed())
      return command.run(options);
  return exit_wrong_input;
}

} // namespace

int main(int argc, char **argv)
{
  const bool speaks = coupling::launch().rank == 0; // of all that mpirun started
  if (argc > 1 && std::string(argv[1]) == "study")  // ranks make shares of it, each by itself
    leave_team();
  try
  {
    MpiRun ranks;
    if (!ranks.serves())
      return run_program(argc, argv);
    ranks.serve();
    return exit_done;
  }
  catch (const std::invalid_argument &error)
  {
    if (speaks)
      std::cerr << "gestell: " << error.what() << '\n';
    return exit_wrong_input;
  }
  catch (const std::bad_alloc &)
  {
    if (speaks)
      std::cerr << "gestell: the computation failed: out of memory; take a coarser mesh (mesh.size), fewer modes "
                   "(reduction.modes) or a larger step of what is kept (output.step, output.picture_step, "
                   "output.stress.step), or a machine with more memory\n";
    return exit_failed;
  }
  catch (const std::exception &error)
  {
    if (interruption()) // what was under way then fails somewhere
    {
      if (speaks)
        std::cerr << "gestell: interrupted: " << error.what() << '\n';
      return exit_interrupted;
    }
    if (speaks)
      std::cerr << "gestell: the computation failed: " << error.what() << '\n';
    return exit_failed;
  }
}
