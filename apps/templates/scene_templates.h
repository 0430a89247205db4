#pragma once

#include <string>
#include <vector>

namespace gestell::apps
{

/// An initial machine: scene and script of its frame, in which NAME is replaced by the name of their files.
struct SceneTemplate
{
  std::string kind; ///< "press"
  std::string scene, frame;
};

/// All templates, in the order of their listing.
std::vector<SceneTemplate> scene_templates();

/// @throws std::invalid_argument with the most similar kind and all of them
SceneTemplate scene_template(const std::string &kind);

/// The template with `name` in place of NAME.
SceneTemplate named(SceneTemplate draft, const std::string &name);

/// First line of the scene without "# ", to its full stop or colon.
std::string headline(const SceneTemplate &any);

} // namespace gestell::apps
