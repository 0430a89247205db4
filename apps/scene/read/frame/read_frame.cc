#include "apps/scene/read/frame/read_frame.h"

#include "apps/scene/read/frame/geometry_keys.h"
#include "apps/scene/read/frame/matrix_keys.h"

#include <stdexcept>
#include <string>
#include <utility>

namespace gestell::apps
{

namespace
{

/// Refuses flexible interfaces: the mechanism acts on nodes with six DOFs, which flexible faces lack.
void refuse_flexible(const fem::FrameSpecification &frame)
{
  for (const fem::InterfaceSpecification &interface : frame.interfaces)
    if (interface.coupling == fem::InterfaceCoupling::flexible)
      throw std::invalid_argument(interface.place +
                                  ": coupling = \"flexible\" applies only to faces in a weld or contact of parts; for "
                                  "a flexible surface that carries a mechanism use coupling = \"average\"");
}

} // namespace

FrameRequest read_frame(const SceneTable &scene)
{
  FrameRequest request;
  const auto   frame = scene.optional_table("frame");
  if (!frame)
    return request;
  request.place = frame->place();

  const bool cad      = frame->has("cad"),
             matrices = (frame->has("mass") && !frame->is_table("mass")) || frame->has("stiffness"),
             reduced = frame->has("reduced"), parts = frame->has("part");
  if (cad + matrices + reduced + parts != 1)
  {
    std::string given;
    for (const auto &[is_given, key] : {std::pair(cad, "'cad'"), std::pair(matrices, "'mass' or 'stiffness'"),
                                        std::pair(reduced, "'reduced'"), std::pair(parts, "'part'")})
      if (is_given)
        given += (given.empty() ? " and has " : " and ") + std::string(key);
    throw frame->error(
        "needs exactly one of 'cad' (a CAD or mesh file), 'mass' with 'stiffness' (matrices), 'reduced' "
        "(a reduced frame) and 'part' (tables of several parts)" +
        (given.empty() ? "; remove [frame] for a machine without a frame" : given + "; keep one of them"));
  }
  if (!cad && frame->has("parts"))
    throw frame->error(
        "parts", "cuts the mesh of a frame from 'cad'; a frame " +
                     std::string(parts ? "of parts has one mesh for each" : "that is given by matrices has no mesh") +
                     "; remove it");
  if (cad)
  {
    request.source         = FrameSource::geometry;
    const SceneTable whole = frame->declared(frame_keys());
    request.geometry       = read_frame_geometry(whole, scene);
    if (const auto prestress = whole.optional_table("prestress"))
      request.geometry.prestress = read_surface_loads(*prestress, scene, request.geometry);
    refuse_flexible(request.geometry);
  }
  else if (parts)
  {
    request.source = FrameSource::parts;
    request.parts  = read_frame_parts(*frame, scene);
  }
  else if (matrices)
  {
    request.source   = FrameSource::matrices;
    request.matrices = read_frame_matrices(frame->declared(matrix_frame_keys()), request.has_translations);
  }
  else
  {
    request.source       = FrameSource::reduced_file;
    request.reduced_file = frame->declared(frame_keys()).file("reduced");
  }
  return request;
}

std::vector<std::string> interface_names(const FrameRequest &frame)
{
  std::vector<std::string> names;
  for (const auto &interface : frame.geometry.interfaces)
    names.push_back(interface.name);
  for (const auto &interface : frame.matrices.interfaces)
    names.push_back(interface.name);
  for (const std::string &kept : coupling::kept_interfaces(frame.parts))
    names.push_back(kept);
  return names;
}

} // namespace gestell::apps
