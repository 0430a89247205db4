#include "fem/geometry/shared_faces.h"

#include <algorithm>
#include <stdexcept>

namespace gestell::fem
{

namespace
{

struct Owner
{
  std::string                     what; ///< "interface \"crown\""
  const std::vector<std::string> *surfaces;
  std::string                     place;
};

/// The supports, masses and interfaces that determine the motion of their whole surfaces.
std::vector<Owner> owners_of(const FrameSpecification &specification)
{
  std::vector<Owner> owners;
  for (const Support &support : specification.supports)
    if (support.kind == SupportKind::clamped)
      owners.push_back({"clamped support \"" + support.name + "\"", &support.surfaces, support.place});
  for (const AttachedMass &mass : specification.masses)
    owners.push_back({"mass \"" + mass.name + "\"", &mass.surfaces, mass.place});
  for (const InterfaceSpecification &interface : specification.interfaces)
    if (interface.coupling != InterfaceCoupling::point)
      owners.push_back({"interface \"" + interface.name + "\"", &interface.surfaces, interface.place});
  return owners;
}

} // namespace

void require_faces_of_one_owner(const std::map<std::string, std::vector<int>> &selection,
                                const std::vector<Face> &faces, const FrameSpecification &specification)
{
  const std::vector<Owner>                           owners = owners_of(specification);
  std::map<int, std::pair<std::size_t, std::string>> first; // tag to owner and name of the surface
  for (std::size_t i = 0; i < owners.size(); ++i)
    for (const std::string &surface : *owners[i].surfaces)
    {
      const auto tags = selection.find(surface);
      if (tags == selection.end())
        continue; // reported where surfaces are selected
      for (const int tag : tags->second)
      {
        const auto [entry, is_new] = first.try_emplace(tag, i, surface);
        if (is_new || entry->second.first == i)
          continue;
        const auto face =
            std::find_if(faces.begin(), faces.end(), [&, tag = tag](const Face &f) { return f.tag == tag; });
        throw std::invalid_argument(
            owners[i].place + ": its surface \"" + surface + "\" and the surface \"" + entry->second.second + "\" of " +
            owners[entry->second.first].what + " are the same face (" +
            (face == faces.end() ? std::to_string(tag) : describe(*face)) +
            "), which can follow only one of them; give each its own faces, or join them in one interface.");
      }
    }
}

} // namespace gestell::fem
