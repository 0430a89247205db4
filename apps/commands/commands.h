#pragma once

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

/// What every subcommand takes.
struct CommonOptions
{
  std::string              input;  ///< scene, or CAD file of `gestell mesh`
  std::string              folder; ///< -o; empty: results/<scene name>
  std::vector<std::string> overrides;
  int                      jobs  = 1;
  bool                     quiet = false;
};

struct MeshCommandOptions
{
  double      size      = 0.; ///< [m]; 0: a thirtieth of the model's diagonal
  double      max_cells = 2e6;
  double      unit      = 0.; ///< length unit of the file [m]; 0: the file knows
  std::string material  = "steel";
};

/// Each returns an ExitCode; wrong input throws std::invalid_argument, failed methods ConvergenceFailure.
int run_command(const CommonOptions &options);
int modes_command(const CommonOptions &options);
int reduce_command(const CommonOptions &options);
int mesh_command(const CommonOptions &options, const MeshCommandOptions &mesh);
int check_command(const CommonOptions &options);

} // namespace gestell::apps
