#include "apps/command_line/command_line.h"

#include "apps/output/text/page_language.h"
#include "apps/session/commit.h"
#include "apps/version.h"
#include "fem/values/named_file.h"
#include "fem/values/nearest_name.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <variant>

namespace gestell::apps
{
namespace
{

CLI::Validator existing()
{
  return CLI::Validator(
      [](const std::string &path)
      {
        std::error_code error;
        if (std::filesystem::is_regular_file(path, error))
          return std::string();
        const std::string other = fem::other_than_file(path);
        return other.empty() ? "there is no file " + path + "; relative paths start at the working directory"
                             : path + " is " + other + "; a file is needed";
      },
      "FILE");
}

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

CLI::Validator at_most(double most)
{
  return CLI::Validator(
      [most](const std::string &text)
      {
        return std::strtod(text.c_str(), nullptr) <= most
                   ? std::string()
                   : "needs a number up to " + rounded(most, 15) + ", got " + text;
      },
      "");
}

std::vector<std::string> command_names(const CLI::App &program)
{
  std::vector<std::string> names;
  for (const CLI::App *command : program.get_subcommands([](const CLI::App *) { return true; }))
    names.push_back(command->get_name());
  return names;
}

CLI::Validator not_empty()
{
  return CLI::Validator([](const std::string &text)
                        { return text.empty() ? "is empty; give a value, or omit the option" : std::string(); },
                        "");
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
                  study ? "number of processes for the runs (default 1)"
                        : "threads of linear algebra for the frame, or number of parts reduced at a time (default 1)")
      ->check(above_zero());
  command.add_flag("--quiet", options.quiet, "no progress on standard error");
  command
      .add_option_function<std::string>("--language", choose_page_language,
                                        "language of headings, column heads and captions of the report: en or de")
      ->check(CLI::IsMember(page_languages()));
  command.add_flag_callback(
      "--trust-scripts", [&options] { options.scripts = fem::Scripts::trusted; },
      "accept gmsh scripts (.geo) without a check; they may run programs and write files");
  if (cad)
    return;
  command
      .add_option("-o,--output", options.folder,
                  study ? "folder for results (default results/<study name>)"
                        : "folder for results (default results/<scene name>)")
      ->check(not_empty());
  command
      .add_option("--set", options.overrides,
                  study ? "override a key of the study or of its scene: key.path=value"
                        : "override a scene key: key.path=value")
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
  if (option.most > 0.)
    added->check(at_most(option.most));
  if (option.range == CommandOption::Range::existing_file)
    added->check(existing());
  if (std::holds_alternative<std::string *>(option.value))
    added->check(not_empty());
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
  added->add_flag("--json", "one JSON document on standard output instead of text");
  added->add_flag("--apart", "each process of mpirun or srun computes its own case (also by GESTELL_APART=1)");
  add_input(*added, command.input, options);
  for (const CommandOption &option : command.options)
    add_option(*added, option);
}

} // namespace

std::unique_ptr<CLI::App> command_line(const std::vector<Command> &all, CommonOptions &options)
{
  auto program =
      std::make_unique<CLI::App>("Gestell computes vibrations of a machine together with its frame.", "gestell");
  program->set_version_flag("--version",
                            std::string("gestell ") + version + (commit().empty() ? "" : " (" + commit() + ")"));
  program->require_subcommand(1);
  for (const Command &command : all)
    add_command(*program, command, options);
  return program;
}

void require_command(const CLI::App &program, const std::string &word)
{
  const auto names = command_names(program);
  if (!word.empty() && word.front() != '-' && std::find(names.begin(), names.end(), word) == names.end())
    throw std::invalid_argument("there is no command '" + word + "'" + suggestion(word, names));
}

std::invalid_argument refused(const CLI::App &program, const std::string &why)
{
  const bool        known = !program.get_subcommands().empty();
  const std::string name  = known ? program.get_subcommands().front()->get_name() : "";
  return std::invalid_argument((known ? name + ": " : "") + why + "; gestell " + (known ? name + ' ' : "") +
                               "--help lists its arguments");
}

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
                                    ? "there is no option " + word + suggestion(word, options)
                                    : "'" + word + "' is an unexpected extra argument; names with spaces need quotes"));
}

} // namespace gestell::apps
