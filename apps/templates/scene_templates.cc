#include "apps/templates/scene_templates.h"

#include "fem/values/nearest_name.h"

#include <stdexcept>

namespace gestell::apps
{

namespace
{

std::string replaced(std::string text, const std::string &what, const std::string &by)
{
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
  return text;
}

} // namespace

SceneTemplate scene_template(const std::string &kind)
{
  std::vector<std::string> kinds;
  for (SceneTemplate &any : scene_templates())
  {
    if (any.kind == kind)
      return any;
    kinds.push_back(any.kind);
  }
  const std::string nearest = nearest_name(kind, kinds);
  throw std::invalid_argument("there is no kind of machine '" + kind + "'; the kinds are " + listed(kinds) +
                              (nearest.empty() ? "" : "; did you mean '" + nearest + "'?"));
}

SceneTemplate named(SceneTemplate draft, const std::string &name)
{
  draft.scene = replaced(draft.scene, "NAME", name);
  return draft;
}

std::string headline(const SceneTemplate &any)
{
  return any.scene.substr(2, any.scene.find_first_of(":.\n") - 2);
}

} // namespace gestell::apps
