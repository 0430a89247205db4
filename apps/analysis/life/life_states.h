#pragma once

#include "apps/analysis/life/life_load.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace gestell::apps
{

/// The file of a result folder with the load of a run and the key of its inputs: all that its states depend on, which
/// is the scene without the keys of [life] that only count.
constexpr const char *life_states_file = "life_states.bin";

/// Its content; empty for changes that no line can hold.
std::function<std::string()> life_states_bin(const Variant &scene, const coupling::ReducedFrame &frame,
                                             const std::shared_ptr<LifeLoad> &load);

/// A result folder whose states are counted again.
struct KeptLife
{
  std::filesystem::path    file;
  std::string              scene;   ///< path
  std::vector<std::string> changes; ///< of the run, then those of now
  std::string              bytes;
};

/// What can be given to `gestell life`, with the result folders in a folder that have states.
std::string kept_folders(const std::filesystem::path &beside);

/// @throws std::invalid_argument: no states, a damaged file, or what has changed that they depend on
KeptLife kept_life(const std::filesystem::path &folder, const std::vector<std::string> &changes);

/// @throws std::invalid_argument for another frame
LifeLoad load_of(const KeptLife &kept, Session &session);

} // namespace gestell::apps
