#include "apps/sizing/model_choices.h"

#include "apps/scene/build/build_machine.h"
#include "coupling/plugin/mesh_service.h"

#include <algorithm>

namespace gestell::apps
{

namespace
{

bool is_meshed(const std::string &cad)
{
  const std::string kind = cad.substr(std::min(cad.rfind('.'), cad.size()));
  return kind != ".msh" && kind != ".inp" && kind != ".stl";
}

/// Whether all faces are planes.
bool is_plane(const fem::FrameSpecification &frame, KnownPlanes &known)
{
  if (const auto found = known.find(frame.cad); found != known.end())
    return found->second;
  bool plane = false;
  try
  {
    plane = !coupling::mesh_service().inspect(frame).curved;
  }
  catch (const std::exception &) // meshing will report the error
  {
  }
  return known[frame.cad] = plane;
}

Sides sides_of(const fem::FrameSpecification &frame, KnownPlanes &known)
{
  if (frame.mesh.curved || is_plane(frame, known))
    return Sides::exact;
  return frame.mesh.plates == fem::Plates::tetrahedra && is_meshed(frame.cad) ? Sides::straight : Sides::unknown;
}

} // namespace

bool mesh_is_made(const Scene &scene)
{
  return scene.frame.source == FrameSource::geometry && is_meshed(scene.frame.geometry.cad);
}

bool meshes_of_parts_are_made(const Scene &scene)
{
  const auto &parts = scene.frame.parts.parts;
  return scene.frame.source == FrameSource::parts &&
         std::all_of(parts.begin(), parts.end(),
                     [](const coupling::FramePart &part) { return is_meshed(part.geometry.cad); });
}

bool mesh_can_change(const Scene &scene)
{
  return mesh_is_made(scene) || meshes_of_parts_are_made(scene);
}

Sides sides_of(const Scene &scene, KnownPlanes &known)
{
  if (scene.frame.source == FrameSource::geometry)
    return sides_of(scene.frame.geometry, known);
  Sides all = Sides::exact;
  for (const coupling::FramePart &part : scene.frame.parts.parts)
    all = std::max(all, sides_of(part.geometry, known));
  return all;
}

bool modes_are_chosen(const Scene &scene)
{
  return scene.reduction.superposition || (frame_path(scene) == FramePath::reduce && scene.reduction.method != "guyan");
}

} // namespace gestell::apps
