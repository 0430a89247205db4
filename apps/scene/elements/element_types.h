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

/// What a type of elements is; its reader, help, schema and reference come from it.
struct ElementType
{
  std::string              name;     ///< value of the key `type`
  std::string              does;     ///< one sentence
  std::string              signals;  ///< that it has, in Markdown
  std::vector<Key>         keys;     ///< beside `type` and `initially`
  ElementReader            read;     ///< asks for these keys and no others
  std::vector<std::string> examples; ///< of [element.NAME]; reading them asks for every key
};

/// All types of elements; to add one, write elements/x.cc and its line in element_types.cc.
const std::vector<ElementType> &element_types();

/// `type` and `initially`, which every element has.
std::vector<Key> common_element_keys();

/// Reads all [element.NAME] into the scene.
void read_elements(const SceneTable &table, const Names &names, Scene &scene);

} // namespace gestell::apps
