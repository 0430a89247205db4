#pragma once

#include "apps/analysis/result_folder.h"
#include "apps/cli/command.h"
#include "apps/cli/interruption.h"
#include "apps/output/folder_lock.h"
#include "apps/scene/values/requests.h"
#include "apps/session/checkpoint/input_files.h"

#include <filesystem>
#include <iostream>

namespace gestell::apps
{

/// Folder for results: -o, or else results/<scene name>.
inline std::filesystem::path results_path(const CommonOptions &options, const Scene &scene)
{
  return options.folder.empty() ? std::filesystem::path("results") / scene.name : std::filesystem::path(options.folder);
}

/// A folder for results that can be written and is held, from before anything is computed until they are there; says
/// where it cannot be held.
class ResultsLock
{
public:
  /// @throws std::invalid_argument as require_writable() and FolderLock
  explicit ResultsLock(const std::filesystem::path &folder) : lock_((require_writable(folder), folder))
  {
    end_where_nothing_is_saved();
    if (!lock_.note().empty())
      std::cerr << "gestell: warning: " << lock_.note() << '\n';
  }

private:
  FolderLock lock_;
};

/// Files that the command reads, which no result may replace: those of its scene, and others of its options.
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
