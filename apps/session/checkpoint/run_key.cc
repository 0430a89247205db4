#include "apps/session/checkpoint/run_key.h"

#include "apps/version.h"
#include "coupling/frame/sha256.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

namespace gestell::apps
{

namespace
{

namespace fs = std::filesystem;
using coupling::Sha256;

void add(double number, Sha256 &hash)
{
  hash.update(&number, sizeof number);
}

void add(const Eigen::VectorXd &x, Sha256 &hash)
{
  add(double(x.size()), hash);
  hash.update(x.data(), std::size_t(x.size()) * sizeof(double));
}

void add(const SceneNode &node, Sha256 &hash)
{
  add(double(node.type), hash);
  add(double(node.text.size()), hash);
  hash.update(node.text);
  add(node.number, hash);
  add(double(node.boolean), hash);
  std::map<std::string, const SceneNode *> entries;
  for (const auto &[key, value] : node.entries)
    entries[key] = &value;
  add(double(entries.size() + node.elements.size()), hash);
  for (const auto &[key, value] : entries)
  {
    hash.update(key + '\n');
    add(*value, hash);
  }
  for (const SceneNode &element : node.elements)
    add(element, hash);
}

/// Adds the files named in the scene, with their bytes.
void add_files(const SceneNode &node, Sha256 &hash)
{
  std::error_code error;
  const fs::path  path = fs::path(node.folder) / node.text;
  if (node.type == SceneNode::Type::text && !node.text.empty() && fs::is_regular_file(path, error))
    hash.update(node.text + '\n' + coupling::sha256_of_file(path.string()));
  for (const auto &[key, value] : node.entries)
    add_files(value, hash);
  for (const SceneNode &element : node.elements)
    add_files(element, hash);
}

/// Numbers of M, B and C times a vector that no two coordinates are alike in.
void add_matrices(const coupling::LinearSystem &linear, Sha256 &hash)
{
  Eigen::VectorXd x(linear.size()), y(linear.size());
  for (Eigen::Index i = 0; i < x.size(); ++i)
    x[i] = 1. + std::sin(double(i) * double(i) + 1.);
  linear.mass_times(x, y);
  add(y, hash);
  linear.damping_times(x, y);
  add(y, hash);
  linear.stiffness_times(x, y);
  add(y, hash);
  for (int i = 0; i < linear.size(); ++i)
    hash.update(linear.coordinate_name(i) + '\n');
}

template <typename Fill>
KeyPart part(const std::string &what, const Fill &fill)
{
  Sha256 hash;
  fill(hash);
  return {what, hash.hexadecimal()};
}

} // namespace

KeyPart version_part()
{
  return {"the version of Gestell", std::string(version)};
}

KeyPart scene_part(const std::string &what, const SceneNode &scene)
{
  return part(what, [&](Sha256 &hash) { add(scene, hash); });
}

KeyPart files_part(const std::string &what, const SceneNode &scene)
{
  return part(what, [&](Sha256 &hash) { add_files(scene, hash); });
}

std::vector<KeyPart> run_key(const SceneNode &scene, const coupling::Machine &machine,
                             const coupling::InitialState &start)
{
  return {part("the program",
               [](Sha256 &hash) { hash.update(std::string(version) + coupling::sha256_of_file("/proc/self/exe")); }),
          scene_part("the scene", scene), files_part("a file that the scene names", scene),
          part("the frame or the mass, damping and stiffness of the machine",
               [&](Sha256 &hash) { add_matrices(machine.linear(), hash); }),
          part("the initial state",
               [&](Sha256 &hash)
               {
                 add(start.q, hash);
                 add(start.v, hash);
               })};
}

} // namespace gestell::apps
