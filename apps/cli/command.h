#pragma once

#include "apps/analysis/command_option.h"
#include "fem/values/cad_source.h"

#include <functional>
#include <string>
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

/// Options of every command with an input.
struct CommonOptions
{
  std::string              input;  ///< scene, or CAD file of `gestell mesh`
  std::string              folder; ///< -o; empty: results/<scene name>
  std::vector<std::string> overrides;
  int                      jobs    = 1; ///< number of threads; for a study of processes
  bool                     quiet   = false;
  fem::Scripts             scripts = fem::Scripts::harmless; ///< for gmsh scripts that scenes name
};

/// Type of the input of a command.
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
  std::vector<CommandOption>                options; ///< in addition to the common ones; `run` owns their values
  std::function<int(const CommonOptions &)> run;     ///< @return an ExitCode
};

} // namespace gestell::apps
