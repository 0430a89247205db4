#pragma once

#include "apps/analysis/result_folder.h"
#include "apps/cli/command.h"
#include "apps/cli/interruption.h"
#include "apps/output/folder/own_folder.h"
#include "apps/output/folder_lock.h"
#include "apps/scene/values/requests.h"
#include "apps/session/checkpoint/input_files.h"

#include <filesystem>
#include <iostream>

namespace gestell::apps
{

/// Folder for results: -o, or by default results/<scene name>.
inline std::filesystem::path results_path(const CommonOptions &options, const Scene &scene)
{
  return options.folder.empty() ? std::filesystem::path("results") / scene.name : std::filesystem::path(options.folder);
}

/// Checks that a folder for results is writable and locks it, from before the computation until the results are
/// written; prints a note if it cannot be locked.
class ResultsLock
{
public:
  /// @throws std::invalid_argument as require_writable() and FolderLock do
  explicit ResultsLock(const std::filesystem::path &folder) : lock_((require_writable(folder), folder))
  {
    end_where_nothing_is_saved();
    if (!lock_.note().empty())
      std::cerr << "gestell: warning: " << lock_.note() << '\n';
  }

private:
  FolderLock lock_;
};

/// Says before a computation that its results will replace a run in the folder.
/// @param own  file that results of the command have
inline void say_run_is_replaced(const std::filesystem::path &folder, const std::string &own)
{
  if (const OwnFolder there(folder); there.owns("history.csv") && !there.owns(own))
    std::cout << "the run in " << folder.string() << " will be replaced; use -o DIR to keep it" << std::endl;
}

/// Input files of the command, which no result may replace: those of its scene, and others of its options.
inline std::vector<std::filesystem::path> inputs_of(const CommonOptions            &options,
                                                    const std::vector<std::string> &others = {})
{
  std::vector<std::filesystem::path> inputs = input_files(options.input, options.overrides);
  for (const std::string &file : others)
    if (!file.empty())
      inputs.emplace_back(file);
  return inputs;
}

} // namespace gestell::apps
