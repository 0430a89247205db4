#include "apps/sizing/sized_scene.h"

#include "apps/scene/file/extending_scene.h"
#include "apps/scene/file/scene_override.h"
#include "apps/scene/file/written_text.h"
#include "coupling/integration/integration_methods.h"
#include "fem/values/number_text.h"

#include <algorithm>

namespace gestell::apps
{

namespace
{

std::string number(double value)
{
  const std::string digits = exact_text(value);
  return digits.find_first_of(".e") == std::string::npos ? digits + ".0" : digits;
}

using Entries = std::vector<std::pair<std::string, std::string>>;

/// All that an integration depends on, whatever the scene has of it.
void add_method(const coupling::MethodOptions &options, Entries &entries)
{
  const coupling::IntegrationMethod &method = coupling::method_of(options);
  entries.emplace_back("run.method", written_text(options.method));
  if (options.step > 0.) // of a controlled method the longest; none: as long as may be
    entries.emplace_back("run.step", number(options.step));
  if (controlled(options))
    entries.emplace_back("run.tolerance", number(options.tolerance));
  if (method.takes_order() && method.default_order(options) > 0)
    entries.emplace_back("run.order", std::to_string(options.order));
  for (const coupling::MethodParameter &parameter : method.parameters())
    if (const auto own = options.own.find(parameter.name); own != options.own.end())
      entries.emplace_back("run." + parameter.name, std::holds_alternative<double>(own->second)
                                                        ? number(std::get<double>(own->second))
                                                        : written_text(std::get<std::string>(own->second)));
  entries.emplace_back("run.max_halvings", std::to_string(options.max_halvings));
  if (options.newton.share_of_error == 0.) // given, see read_method_options()
    entries.emplace_back("run.newton_tolerance", number(options.newton.tolerance));
}

} // namespace

std::vector<std::pair<std::string, std::string>> sized_entries(const Scene &scene, const ModelVariant &model)
{
  Entries     sizes;
  const Scene sized = varied(scene, model);
  if (mesh_is_made(scene))
  {
    sizes.emplace_back("frame.mesh.size", number(sized.frame.geometry.mesh.size));
    if (model.cells != Cells::given)
    {
      const fem::MeshOptions &mesh = sized.frame.geometry.mesh;
      sizes.emplace_back("frame.mesh.plates", written_text(mesh.plates == fem::Plates::swept ? "swept" : "tetrahedra"));
      sizes.emplace_back("frame.mesh.curved", mesh.curved ? "true" : "false");
    }
    for (const auto &[surface, size] : sized.frame.geometry.mesh.surface_size)
      sizes.emplace_back("frame.mesh." + written_text(surface), number(size));
  }
  std::vector<std::string> written; // a part that is the same as another has its mesh
  for (const coupling::FramePart &part : sized.frame.parts.parts)
    if (meshes_of_parts_are_made(scene) &&
        std::find(written.begin(), written.end(), part.geometry.place) == written.end())
    {
      const std::string key = "frame.part." + written_text(part.name) + ".mesh.";
      written.push_back(part.geometry.place);
      sizes.emplace_back(key + "size", number(part.geometry.mesh.size));
      if (model.cells == Cells::curved && part.geometry.mesh.curved)
        sizes.emplace_back(key + "curved", "true");
      for (const auto &[surface, size] : part.geometry.mesh.surface_size)
        sizes.emplace_back(key + written_text(surface), number(size));
    }
  if (!written.empty())
    sizes.emplace_back("frame.modes", written_text("all"));
  if (!model.reduction.empty())
    sizes.emplace_back("reduction.method", written_text(model.reduction));
  if (model.modes >= 0)
    sizes.emplace_back("reduction.modes", std::to_string(model.modes));
  add_method(sized.run.options.method, sizes);
  return sizes;
}

std::string sized_scene(const Scene &scene, const std::vector<std::string> &overrides, const ModelVariant &model,
                        const std::filesystem::path &folder)
{
  std::vector<SceneNode::Entry> changes;
  const auto                    add = [&](const std::string &text)
  {
    const auto [key, value] = parsed_override(text);
    add_change(changes, key, value);
  };
  for (const std::string &override : overrides)
    add(override);
  for (const auto &[key, value] : sized_entries(scene, model))
    add(key + '=' + value);
  return extending_scene(scene.name + " with the smallest model that its outputs need, by gestell size.", scene.file,
                         changes, folder);
}

} // namespace gestell::apps
