#pragma once

#include "apps/scene/file/scene_table.h"
#include "apps/scene/read/names.h"
#include "apps/scene/values/requests.h"

namespace gestell::apps
{

/// A type of bodies with its keys, for help and reference.
struct BodyType
{
  std::string      name, does;
  std::vector<Key> keys;
};
const std::vector<BodyType> &body_types();

/// Reads all [body.NAME], in the order of the file, and makes them known to `names`.
std::vector<BodyRequest> read_bodies(const SceneTable &scene, Names &names, fem::Scripts scripts);

} // namespace gestell::apps
