// The program gestell: one executable with subcommands.

#include "apps/cli/commands.h"
#include "apps/cli/interruption.h"
#include "apps/cli/json_answer.h"
#include "apps/cli/team.h"
#include "apps/command_line/command_line.h"
#include "apps/command_line/completion.h"
#include "apps/command_line/man_page.h"
#include "apps/command_line/standard_streams.h"
#include "coupling/frame/atomic_file.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <new>
#include <system_error>

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
    if (error.get_exit_code() != 0)
      throw refused(program, error.what());
    return program.exit(error);
  }

  if (options.jobs > 1)
    setenv("OPENBLAS_NUM_THREADS", std::to_string(options.jobs).c_str(), 1);
  for (const Command &command : all)
    if (program.get_subcommand(command.name)->parsed())
      return command.run(options);
  return exit_wrong_input;
}

/// Reports the reason of a failure, in the terminal or in the JSON document.
int fail(int exit_code, const std::string &message, JsonAnswer &answer)
{
  answer.failed(message);
  if (!answer.wanted() && coupling::launch().rank == 0 &&
      team_left().rank == 0) // of all that mpirun started one speaks
    std::cerr << "gestell: " << message << '\n';
  return exit_code;
}

bool has_word(int argc, char **argv, const std::string &word)
{
  return std::find(argv + 1, argv + argc, word) != argv + argc;
}

/// The command line as ranks compare it.
std::string words_of(int argc, char **argv)
{
  std::string words;
  for (int i = 1; i < argc; ++i)
    words += std::string(" ") + argv[i];
  return words;
}

/// Detaches processes from the common computation: one case per process, or groups of ranks for shares of a study.
void choose_team(int argc, char **argv)
{
  if (has_word(argc, argv, "--apart") || apart_by_environment())
    leave_team();
  else if (argc > 1 && std::string(argv[1]) == "study")
    part_team(words_of(argc, argv));
}

/// Whether a name is at fault that somebody gave, not the computer.
bool is_of_a_name(const std::exception &error)
{
  const auto *of_a_file = dynamic_cast<const std::filesystem::filesystem_error *>(&error);
  return of_a_file && (of_a_file->code() == std::errc::filename_too_long ||
                       of_a_file->code() == std::errc::too_many_symbolic_link_levels);
}

int run_guarded(int argc, char **argv, JsonAnswer &answer)
{
  try
  {
    choose_team(argc, argv);
    MpiRun ranks(words_of(argc, argv));
    if (ranks.serves())
    {
      ranks.serve();
      return exit_done;
    }
    const int exit_code = run_program(argc, argv);
    if (exit_code == exit_done)
      ranks.tell_idle();
    return exit_code;
  }
  catch (const std::invalid_argument &error)
  {
    return fail(exit_wrong_input, error.what(), answer);
  }
  catch (const std::bad_alloc &)
  {
    return fail(exit_failed,
                "the computation failed: out of memory; use a coarser mesh (mesh.size), fewer modes "
                "(reduction.modes) or a longer interval of stored results (output.step, output.picture_step, "
                "output.stress.step), or a machine with more memory",
                answer);
  }
  catch (const coupling::WriteFailure &failure)
  {
    return fail(exit_failed, failure.what(), answer);
  }
  catch (const std::exception &error)
  {
    if (interruption()) // an interruption makes the current work fail
      return fail(exit_interrupted, std::string("interrupted: ") + error.what(), answer);
    if (is_of_a_name(error))
      return fail(exit_wrong_input, std::string(error.what()) + "; give another name", answer);
    return fail(exit_failed, std::string("the computation failed: ") + error.what(), answer);
  }
}

} // namespace

int main(int argc, char **argv)
{
  secure_standard_streams();
  const bool apart  = has_word(argc, argv, "--apart") || apart_by_environment();
  const bool speaks = apart || coupling::launch().rank == 0;
  JsonAnswer answer(speaks && has_word(argc, argv, "--json"));
  const int  exit_code = run_guarded(argc, argv, answer);
  answer.finish(argc > 1 ? argv[1] : "", exit_code);
  const std::string failure = standard_output_failure();
  if (!failure.empty())
    std::cerr << "gestell: " << failure << '\n';
  return failure.empty() ? exit_code : std::max<int>(exit_code, exit_failed);
}
