#include "coupling/substructures/reduced_parts.h"

#include "coupling/frame/frame_cache.h"
#include "coupling/plugin/frame_service_loader.h"
#include "coupling/plugin/mesh_service.h"
#include "coupling/substructures/joined_parts.h"
#include "coupling/substructures/parts_recipe.h"
#include "coupling/substructures/placed_part.h"

#include <stdexcept>

namespace gestell::coupling
{

namespace
{

/// Phases are called after the part.
Progress named_after(const std::string &part, const Progress &progress)
{
  if (!progress)
    return {};
  return [progress, part](const std::string &phase, double share) { progress(part + ": " + phase, share); };
}

ReducedFrame reduced_part(const FramePart &part, const ReductionOptions &options, const Progress &progress)
{
  FrameOrigin origin;
  origin.recipe = recipe_of(part.geometry, options);
  origin.scene  = part.place;
  origin.source = part.geometry.cad;
  return cached_or_made(origin,
                        [&] { return mesh_service().reduce(part.geometry, options, named_after(part.name, progress)); })
      .frame;
}

ReducedFrame where_it_stands(ReducedFrame reduced, const FramePart &part)
{
  try
  {
    return placed(std::move(reduced), part.name, part.placement);
  }
  catch (const std::invalid_argument &error)
  {
    throw std::invalid_argument(part.place + ": " + error.what());
  }
}

} // namespace

ReducedFrame reduced_frame_of_parts(const FrameOfParts &frame, const ReductionOptions &options,
                                    const Progress &progress)
{
  auto parts =
      equal_parts_once(frame, options, [&](const FramePart &part) { return reduced_part(part, options, progress); });
  for (std::size_t i = 0; i < parts.size(); ++i)
    parts[i] = where_it_stands(std::move(parts[i]), frame.parts[i]);
  const JoinedParts joined = join_parts(parts, frame);
  return completed(frame_service().reduce(joined.matrices, joined_options(frame, joined, options),
                                          named_after("joined parts", progress)),
                   joined);
}

} // namespace gestell::coupling
