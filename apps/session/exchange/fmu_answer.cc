#include "apps/session/exchange/fmu_answer.h"

#include "apps/fmu/fmu_model.h"
#include "apps/scene/file/extending_scene.h"
#include "apps/scene/read/frame/matrix_keys.h"
#include "apps/version.h"
#include "coupling/frame/frame_recipe.h"
#include "coupling/frame/reduced_frame_file.h"
#include "coupling/integration/method_options.h"
#include "fem/values/number_text.h"
#include "fem/values/temporary_directory.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

namespace gestell::apps
{
namespace
{

using Type = SceneNode::Type;

/// Values first, as what follows the head of an inner table belongs to that.
void write_table(const SceneNode &table, const std::string &path, std::string &text)
{
  if (!path.empty())
    text += "\n[" + path + "]\n";
  for (const auto &[key, value] : table.entries)
    if (value.type != Type::table)
      text += written_key(key) + " = " + written_value(value) + '\n';
  for (const auto &[key, value] : table.entries)
    if (value.type == Type::table)
      write_table(value, (path.empty() ? "" : path + ".") + written_key(key), text);
}

/// A table as TOML that reads back to the same values.
std::string written_scene(const SceneNode &root)
{
  std::string text;
  write_table(root, "", text);
  return text;
}

namespace fs = std::filesystem;

std::string bytes_of_file(const fs::path &path)
{
  std::ifstream in(path, std::ios::binary);
  if (!in)
    throw std::invalid_argument(path.string() + ": cannot be read");
  return {std::istreambuf_iterator<char>(in), {}};
}

void write_bytes(const fs::path &path, const std::string &bytes)
{
  fs::create_directories(path.parent_path());
  std::ofstream out(path, std::ios::binary);
  out.write(bytes.data(), std::streamsize(bytes.size()));
  if (!out.flush())
    throw std::runtime_error(path.string() + ": cannot be written; is the disk full?");
}

void erase(SceneNode &table, const std::vector<std::string> &keys)
{
  const auto goes = [&](const SceneNode::Entry &entry)
  { return std::find(keys.begin(), keys.end(), entry.first) != keys.end(); };
  table.entries.erase(std::remove_if(table.entries.begin(), table.entries.end(), goes), table.entries.end());
}

SceneNode text_node(const std::string &text)
{
  SceneNode node;
  node.type = SceneNode::Type::text;
  node.text = text;
  return node;
}

bool may_be_file(const Key &key)
{
  return key.form == Key::Form::file ||
         std::find(key.others.begin(), key.others.end(), Key::Form::file) != key.others.end();
}

/// Adds the files that keys of a table name to the archive, and makes the keys name them there.
void take_files(SceneNode &table, const std::vector<Key> &keys, std::map<std::string, std::string> &files)
{
  for (auto &[name, value] : table.entries)
    if (const Key *key = find_key(keys, name); key && value.type == SceneNode::Type::text && may_be_file(*key))
    {
      const fs::path    file  = fs::path(value.folder) / value.text;
      const std::string taken = "files/" + std::to_string(files.size()) + "_" + file.filename().string();
      files[taken]            = bytes_of_file(file);
      value.text              = taken;
    }
}

/// Bodies from CAD, which name files too, are refused; a frame that is reduced is one file already.
void take_frame_files(SceneNode &root, std::map<std::string, std::string> &files)
{
  if (SceneNode *const frame = files.count("frame.h5") == 0 ? root.find("frame") : nullptr)
    take_files(*frame, matrix_frame_keys(), files);
}

/// A name that C allows.
std::string identifier_of(const std::string &name)
{
  std::string identifier;
  for (const unsigned char c : name)
    identifier += std::isalnum(c) && c < 128 ? char(c) : '_';
  return identifier.empty() || std::isdigit(static_cast<unsigned char>(identifier[0])) ? "m_" + identifier : identifier;
}

void require_portable(const Scene &scene)
{
  for (const BodyRequest &body : scene.bodies)
    if (body.part)
      throw std::invalid_argument(
          body.place +
          ": the body is defined by CAD, which an FMU cannot read; give its mass, inertia and position as numbers (" +
          body.part->found + ")");
  if (scene.reduction.superposition)
    throw std::invalid_argument(scene.reduction.options.place +
                                ": modal superposition is not possible in an FMU; use another reduction.method");
  if (scene.start.periodic)
    throw std::invalid_argument(
        scene.start.place +
        ": an FMU does not search for periodic solutions; use rule = \"given\", \"static\" or \"steady\"");
  if (frame_path(scene) == FramePath::sparse)
    throw std::invalid_argument(
        scene.frame.place +
        ": the frame is not reduced; use a reduction.method that gives a reduced frame, such as \"craig-bampton\"");
}

/// Replaces the frame by a file that is available.
void take_frame(SceneNode &root, Session &session, FmuResources &resources, std::map<std::string, std::string> &files,
                std::vector<std::string> &notes)
{
  const FramePath path = frame_path(session.scene());
  if (path != FramePath::reduce && path != FramePath::from_file)
    return;
  const fem::TemporaryDirectory folder;
  const fs::path                file  = folder.path() / "frame.h5";
  const auto                    frame = path == FramePath::reduce ? session.reduced_frame().frame
                                                                  : coupling::read_reduced_frame(session.scene().frame.reduced_file);
  coupling::write_reduced_frame(file.string(), frame);
  files["frame.h5"] = bytes_of_file(file);
  SceneNode of_frame;
  for (const char *const key : {"frame", "reduction"})
    if (const SceneNode *table = root.find(key))
      of_frame.entries.emplace_back(key, *table);
  resources.frozen = parameters_in(of_frame, root.find("parameters"));
  erase(root, {"frame", "reduction"});
  SceneNode reduced;
  reduced.entries.emplace_back("reduced", text_node("frame.h5"));
  root.entries.emplace_back("frame", reduced);
  if (!resources.frozen.empty())
    notes.push_back("the frame is reduced at the export: " + std::to_string(resources.frozen.size()) +
                    " parameters that it depends on cannot be set in the FMU");
}

void keep_signals_alone(SceneNode &root)
{
  erase(root, {"extends", "without", "modes"});
  SceneNode *output = root.find("output");
  if (!output)
    return;
  const SceneNode *signals = output->find("signals");
  SceneNode        kept;
  if (signals)
    kept.entries.emplace_back("signals", *signals);
  *output = kept;
}

/// Equal only for equal files.
std::string guid_of(const std::map<std::string, std::string> &files)
{
  coupling::Recipe recipe{{"version", version}};
  for (const auto &[name, bytes] : files)
    recipe.push_back({name, bytes});
  return "{" + coupling::content_key(recipe) + "}";
}

std::string without(std::string text, const std::string &part)
{
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part))
    text.erase(at, part.size());
  return text;
}

FmuDescription described(const FmuModel &model)
{
  constexpr double steps  = 100.; ///< about this number of communication steps in a run
  const Scene     &scene  = model.scene();
  const auto      &run    = scene.run.options;
  const double     h      = run.method.step;
  const bool       fixed  = h > 0. && !coupling::controlled(run.method);
  const double     wanted = (run.end - run.begin) / steps;
  FmuDescription   fmu{scene.name, scene.description, identifier_of(scene.name), model.resources().guid, version, {}};
  fmu.variables = model.interface();
  fmu.begin     = run.begin;
  fmu.end       = run.end;
  fmu.step      = fixed ? h * std::max(1., std::floor(wanted / h)) : wanted;
  return fmu;
}

} // namespace

FmuAnswer fmu_of(Session &session)
{
  session.check_run();
  require_portable(session.scene());
  FmuAnswer                          answer;
  FmuResources                       resources;
  SceneNode                          flat = session.variant().root;
  std::map<std::string, std::string> files;
  keep_signals_alone(flat);
  take_frame(flat, session, resources, files, answer.notes);
  take_frame_files(flat, files);
  files["scene.toml"] = written_scene(flat);
  resources.guid      = guid_of(files);
  files["fmu.toml"]   = resources.text();

  const fem::TemporaryDirectory folder;
  for (const auto &[name, bytes] : files)
    write_bytes(folder.path() / name, bytes);
  try
  {
    FmuModel model(folder.path());
    model.start();
    answer.fmu = described(model);
  }
  catch (const std::invalid_argument &error)
  {
    throw std::invalid_argument("the scene as an FMU: " + without(error.what(), folder.path().string() + "/"));
  }
  for (const auto &[name, bytes] : files)
    answer.files["resources/" + name] = bytes;
  return answer;
}

} // namespace gestell::apps
