#pragma once

#include "apps/scene/file/scene_table.h"
#include "apps/scene/read/names.h"
#include "apps/scene/values/requests.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/// Reads one [element.NAME] and adds to the scene what it is made of.
using ElementReader = void (*)(const SceneTable &table, const Names &names, Scene &scene);

struct ElementType
{
  std::string   name; ///< value of the key `type`
  ElementReader read;
};

/// All types of elements; to add one, write elements/x.cc and its line here.
const std::vector<ElementType> &element_types();

/// Reads all [element.NAME] into the scene.
void read_elements(const SceneTable &table, const Names &names, Scene &scene);

} // namespace gestell::apps
