#pragma once

#include "fem/values/cad_source.h"

#include <functional>
#include <string>
#include <variant>
#include <vector>

namespace gestell::apps
{

/// Exit codes of the program.
enum ExitCode
{
  exit_done        = 0,
  exit_wrong_input = 2,
  exit_failed      = 3,
  exit_interrupted = 130
};

/// What every command with an input takes.
struct CommonOptions
{
  std::string              input;  ///< scene, or CAD file of `gestell mesh`
  std::string              folder; ///< -o; empty: results/<scene name>
  std::vector<std::string> overrides;
  int                      jobs    = 1; ///< threads; of a study processes
  bool                     quiet   = false;
  fem::Scripts             scripts = fem::Scripts::harmless; ///< of gmsh, that scenes name
};

/// An option of a command, as it is typed, told and checked.
struct CommandOption
{
  using Value = std::variant<bool *, int *, double *, std::string *, std::vector<std::string> *, std::vector<int> *,
                             std::vector<double> *>;
  enum class Range
  {
    any,
    above_zero,
    existing_file
  };

  std::string              name; ///< "--jobs"; "--peers,!--no-peers" of a flag with its opposite; "KEY" without a name
  Value                    value;
  std::string              does;
  Range                    range     = Range::any;
  std::vector<std::string> choices   = {}; ///< empty: any text
  std::string              needs     = ""; ///< option without which it has no meaning
  std::vector<std::string> proposals = {}; ///< words for completion, where others are refused elsewhere or are none
  double                   most      = 0.; ///< of a number that memory grows with; 0: any

  CommandOption above_zero() const;
  CommandOption at_most(double number) const;
  CommandOption existing_file() const;
  CommandOption one_of(const std::vector<std::string> &names) const;
  CommandOption proposing(const std::vector<std::string> &words) const;
  CommandOption with(const std::string &option) const; ///< needs it
};

/// What the command is about.
enum class CommandInput
{
  none,
  scene,
  scene_or_none,
  cad,
  study
};

/// A command of the program: `gestell NAME INPUT`.
struct Command
{
  std::string                               name, does;
  std::vector<std::string>                  examples;
  CommandInput                              input = CommandInput::scene;
  std::vector<CommandOption>                options; ///< beside the common ones; their values belong to `run`
  std::function<int(const CommonOptions &)> run;     ///< @return an ExitCode
};

} // namespace gestell::apps
