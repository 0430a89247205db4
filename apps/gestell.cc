// The program gestell: one executable with subcommands.

#include "apps/cli/commands.h"
#include "apps/cli/interruption.h"
#include "apps/cli/team.h"
#include "apps/session/commit.h"
#include "apps/version.h"
#include "fem/values/nearest_name.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <new>
#include <variant>

namespace
{

/// CLI11's own check prints the largest number there is, with all its digits.
CLI::Validator above_zero()
{
  return CLI::Validator(
      [](const std::string &text)
      {
        char        *end   = nullptr;
        const double value = std::strtod(text.c_str(), &end);
        return *end == '\0' && !text.empty() && value > 0. && std::isfinite(value)
                   ? std::string()
                   : "needs a plain number above zero, got " + text;
      },
      "NUMBER");
}

using namespace gestell::apps;
namespace coupling = gestell::coupling;

std::vector<std::string> command_names(const CLI::App &program)
{
  std::vector<std::string> names;
  for (const CLI::App *command : program.get_subcommands([](const CLI::App *) { return true; }))
    names.push_back(command->get_name());
  return names;
}

/// The first word is no option and no command.
void require_command(const CLI::App &program, const std::string &word)
{
  const auto names = command_names(program);
  if (!word.empty() && word.front() != '-' && std::find(names.begin(), names.end(), word) == names.end())
    throw std::invalid_argument("there is no command '" + word + "'" + gestell::suggestion(word, names));
}

/// What is left of the command line: an option of another command, a slip, a second scene.
std::invalid_argument unexpected(const CLI::App &program)
{
  const CLI::App          *command = program.get_subcommands().empty() ? &program : program.get_subcommands().front();
  const std::string        word    = program.remaining(true).front();
  std::vector<std::string> options;
  for (const CLI::Option *option : command->get_options())
    for (const std::string &name : option->get_lnames())
      options.push_back("--" + name);
  return std::invalid_argument(command->get_name() + ": " +
                               (word.front() == '-'
                                    ? "there is no option " + word + gestell::suggestion(word, options)
                                    : "'" + word + "' is one input too many; names with spaces stand in quotes"));
}

/// "SCENE" or "CAD", and what goes with it.
void add_input(CLI::App &command, CommandInput input, CommonOptions &options)
{
  if (input == CommandInput::none)
    return;
  const bool cad = input == CommandInput::cad, study = input == CommandInput::study;
  command
      .add_option(cad     ? "CAD"
                  : study ? "STUDY"
                          : "SCENE",
                  options.input,
                  cad     ? "STEP, BREP, .geo or .msh file"
                  : study ? "study file (TOML)"
                          : "scene file (TOML)")
      ->required(input != CommandInput::scene_or_none);
  command
      .add_option("--jobs", options.jobs,
                  study ? "processes that make runs side by side (default 1)"
                        : "threads of the linear algebra that makes a frame (default 1)")
      ->check(above_zero());
  command.add_flag("--quiet", options.quiet, "no progress on standard error");
  command.add_flag_callback(
      "--trust-scripts", [&options] { options.scripts = gestell::fem::Scripts::trusted; },
      "run scripts of gmsh (.geo) as they are, which may run programs and write files");
  if (cad)
    return;
  command.add_option("-o,--output", options.folder,
                     study ? "folder for results (default results/<study name>)"
                           : "folder for results (default results/<scene name>)");
  command
      .add_option("--set", options.overrides,
                  study ? "override an entry of the study or of its scene: key.path=value"
                        : "override an entry of the scene: key.path=value")
      ->allow_extra_args(false);
}

/// A bool is a flag, a list is parted by commas.
struct AddOption
{
  CLI::App            &command;
  const CommandOption &option;

  CLI::Option *operator()(bool *value) const { return command.add_flag(option.name, *value, option.does); }
  template <typename T>
  CLI::Option *operator()(std::vector<T> *value) const
  {
    return command.add_option(option.name, *value, option.does)->delimiter(',');
  }
  template <typename T>
  CLI::Option *operator()(T *value) const
  {
    return command.add_option(option.name, *value, option.does);
  }
};

void add_option(CLI::App &command, const CommandOption &option)
{
  CLI::Option *added = std::visit(AddOption{command, option}, option.value);
  if (option.range == CommandOption::Range::above_zero)
    added->check(above_zero());
  if (option.range == CommandOption::Range::existing_file)
    added->check(CLI::ExistingFile);
  if (std::holds_alternative<std::string *>(option.value))
    added->check([](const std::string &text)
                 { return text.empty() ? "is empty; give it a value, or leave it out" : std::string(); });
  if (!option.choices.empty())
    added->check(CLI::IsMember(option.choices));
  if (!option.needs.empty())
    added->needs(command.get_option(option.needs));
}

void add_command(CLI::App &program, const Command &command, CommonOptions &options)
{
  CLI::App   *added  = program.add_subcommand(command.name, command.does);
  std::string footer = "Example:";
  for (const std::string &example : command.examples)
    footer += "\n  " + example;
  added->footer(footer);
  add_input(*added, command.input, options);
  for (const CommandOption &option : command.options)
    add_option(*added, option);
}

int run_program(int argc, char **argv)
{
  CLI::App program{"Gestell computes how a machine and the frame that carries it shake each other.", "gestell"};
  program.set_version_flag("--version",
                           std::string("gestell ") + version + (commit().empty() ? "" : " (" + commit() + ")"));
  program.require_subcommand(1);
  CommonOptions              options;
  const std::vector<Command> all = commands();
  for (const Command &command : all)
    add_command(program, command, options);

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
