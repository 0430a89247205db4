#include "apps/analysis/life/life_states.h"

#include "apps/analysis/result_folder.h"
#include "apps/scene/file/scene_override.h"
#include "apps/session/checkpoint/checkpoint_file.h"
#include "coupling/frame/sha256.h"
#include "coupling/integration/system/state_archive.h"
#include "fem/values/nearest_name.h"

#include <algorithm>
#include <fstream>
#include <set>
#include <stdexcept>

namespace gestell::apps
{
namespace
{

namespace fs = std::filesystem;
using coupling::ReducedFrame;

/// The scene without the keys of [life] that do not change states: all but the interval and the scenes of the blocks.
SceneNode states_part(SceneNode root)
{
  SceneNode *life = root.find("life");
  if (!life)
    return root;
  const auto keep = [](SceneNode &table, std::initializer_list<const char *> keys)
  {
    const auto is_other = [&](const SceneNode::Entry &entry)
    { return std::none_of(keys.begin(), keys.end(), [&](const char *key) { return entry.first == key; }); };
    table.entries.erase(std::remove_if(table.entries.begin(), table.entries.end(), is_other), table.entries.end());
  };
  keep(*life, {"step", "block"});
  if (SceneNode *blocks = life->find("block"))
    for (SceneNode &block : blocks->elements)
      keep(block, {"scene"});
  return root;
}

/// A line of the key that only records.
KeyPart record(const std::string &what)
{
  return {what, "-"};
}

const std::string scene_line = "- scene ", change_line = "- --set ";

void add_scene(const std::string &name, const SceneNode &root, std::vector<KeyPart> &key)
{
  SceneNode scene = states_part(root);
  std::sort(scene.entries.begin(), scene.entries.end(), [](const auto &a, const auto &b) { return a.first < b.first; });
  for (const auto &[table, value] : scene.entries)
  {
    key.push_back(scene_part("'" + table + "' of " + name, value));
    if (table != "life") // scenes of blocks, whose keys follow
      key.push_back(files_part("a file named by '" + table + "' of " + name, value));
  }
}

std::vector<KeyPart> life_key(const Variant &scene, const std::vector<std::string> &recorded)
{
  std::vector<KeyPart> key = {version_part(), record("scene " + fs::absolute(scene.path).lexically_normal().string())};
  for (const std::string &change : recorded)
    key.push_back(record("--set " + change));
  add_scene("the scene", scene.root, key);
  const auto life = scene.scene().life;
  for (const BlockRequest &block : life->blocks)
    add_scene("the block " + fs::path(block.file).filename().string(), block_variant(scene, block).root, key);
  return key;
}

/// Of all that turns states into stresses, with products for the large matrices.
std::string fingerprint(const ReducedFrame &frame)
{
  coupling::Sha256      hash;
  const auto            add = [&](const auto &x) { hash.update(x.data(), sizeof(*x.data()) * std::size_t(x.size())); };
  const Eigen::VectorXf weights =
      Eigen::VectorXf::NullaryExpr(frame.stress.mean.cols(), [](Eigen::Index i) { return 1.f + 0.1f * float(i % 7); });
  add(frame.M);
  add(frame.B);
  add(frame.C);
  add(Eigen::VectorXf(frame.stress.mean * weights));
  add(Eigen::VectorXf(frame.stress.deviation * weights));
  return hash.hexadecimal();
}

void exchange_states(coupling::StateArchive &archive, LifeLoad &load, std::string &frame)
{
  archive(frame, load.states, load.t, load.sequence.blocks, load.windows, load.before, load.step);
}

/// The keys among the changes that change the states.
std::string keys_of_states(const Variant &then, const std::vector<std::string> &changes)
{
  const std::string before = scene_part("", states_part(then.root)).hash;
  std::string       keys;
  for (const std::string &change : changes)
    if (scene_part("", states_part(then.with(change).root)).hash != before)
      keys += (keys.empty() ? "" : ", ") + parsed_override(change).first;
  return keys;
}

} // namespace

std::function<std::string()> life_states_bin(const Variant &scene, const ReducedFrame &frame,
                                             const std::shared_ptr<LifeLoad> &load)
{
  for (const std::string &change : scene.changes)
    if (change.find('\n') != std::string::npos)
      return {};
  return [key = life_key(scene, scene.changes), frame = fingerprint(frame), load]() mutable
  {
    coupling::StateArchive archive;
    exchange_states(archive, *load, frame);
    return checkpoint_text(key, archive.bytes());
  };
}

std::string kept_folders(const fs::path &beside)
{
  std::set<std::string> known; // in order
  std::error_code       unreadable;
  for (const auto &entry : fs::directory_iterator(beside.empty() ? fs::path(".") : beside, unreadable))
    if (fs::exists(entry.path() / life_states_file, unreadable))
      known.insert(entry.path().filename().string());
  return "give a scene (.toml), or the result folder of a run with [life], which contains " +
         std::string(life_states_file) +
         (known.empty()
              ? ""
              : ": in " + (beside.empty() ? "." : beside.string()) + " " + listed({known.begin(), known.end()}));
}

KeptLife kept_life(const fs::path &folder, const std::vector<std::string> &changes)
{
  KeptLife   kept{folder / life_states_file, "", {}, ""};
  const auto refuse = [&](const std::string &why) { throw std::invalid_argument(why + "; use `gestell life SCENE`"); };
  if (incomplete(folder))
    refuse(incomplete_words(folder));
  std::ifstream in(kept.file, std::ios::binary);
  if (!in)
    throw std::invalid_argument(folder.string() + " contains no " + life_states_file +
                                ", the states of a run with [life]; " + kept_folders((folder / "").parent_path().parent_path()));
  bool has_state = false;
  for (std::string line; !has_state && std::getline(in, line); has_state = line.find(" state") == 64)
    if (line.rfind(scene_line, 0) == 0)
      kept.scene = line.substr(scene_line.size());
    else if (line.rfind(change_line, 0) == 0)
      kept.changes.push_back(line.substr(change_line.size()));
  if (!has_state)
    refuse(kept.file.string() + " is damaged");
  if (!fs::exists(kept.scene))
    refuse(kept.file.string() + ": its scene " + kept.scene + " does not exist");
  Variant scene = Variant::of_file(kept.scene, kept.changes);
  if (const std::string keys = keys_of_states(scene, changes); !keys.empty())
    refuse("--set: the states in " + folder.string() + " depend on " + keys +
           "; only keys of [life] can be changed, except its step and the scenes of blocks");
  const std::vector<std::string> then = kept.changes;
  for (const std::string &change : changes)
    kept.changes.push_back(scene.set(change).changes.back());
  kept.bytes = read_checkpoint(kept.file, life_key(scene, then), "life", "use `gestell life SCENE`");
  return kept;
}

LifeLoad load_of(const KeptLife &kept, Session &session)
{
  coupling::StateArchive archive(kept.bytes);
  LifeLoad               load;
  std::string            frame;
  exchange_states(archive, load, frame);
  if (frame != fingerprint(*session.machine().machine.model().reduced_frame()))
    throw std::invalid_argument(kept.file.string() + ": the frame is not that of the run, because this version of "
                                                     "Gestell or gmsh makes another one; use `gestell life SCENE`");
  weigh(load, session.variant(), session.scene());
  return load;
}

} // namespace gestell::apps
