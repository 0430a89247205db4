#pragma once

#include "apps/scene/file/scene_table.h"
#include "apps/scene/read/names.h"
#include "apps/scene/values/requests.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/// Reads one [element.NAME] and adds its parts to the scene.
using ElementReader = void (*)(const SceneTable &table, const Names &names, Scene &scene);

/// A type of elements; its reader, help, schema and reference are generated from this.
struct ElementType
{
  std::string              name;     ///< value of the key `type`
  std::string              does;     ///< description in one sentence
  std::string              signals;  ///< of the type, in Markdown
  std::vector<Key>         keys;     ///< in addition to `type` and `initially`
  ElementReader            read;     ///< reads these keys and no others
  std::vector<std::string> examples; ///< of [element.NAME]; together they use every key
};

/// All types of elements; to add one, write elements/x.cc and its line in element_types.cc.
const std::vector<ElementType> &element_types();

/// `type` and `initially`, which every element has.
std::vector<Key> common_element_keys();

/// Reads all [element.NAME] into the scene.
void read_elements(const SceneTable &table, const Names &names, Scene &scene);

} // namespace gestell::apps
