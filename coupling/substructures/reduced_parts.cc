#include "coupling/substructures/reduced_parts.h"

#include "coupling/frame/frame_cache.h"
#include "coupling/plugin/frame_service_loader.h"
#include "coupling/plugin/mesh_service.h"
#include "coupling/substructures/joined_parts.h"
#include "coupling/substructures/parts_recipe.h"
#include "coupling/substructures/placed_part.h"
#include "coupling/substructures/prestress_statement.h"
#include "coupling/substructures/prestressed_parts.h"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

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

} // namespace

ReducedFrame reduced_frame_of_parts(const FrameOfParts &given, const ReductionOptions &options,
                                    const Progress &progress)
{
  const auto reduced = [&](const FrameOfParts &description)
  {
    return equal_parts_once(description, options,
                            [&](const FramePart &part) { return reduced_part(part, options, progress); });
  };
  FrameOfParts frame    = given;
  auto         parts    = reduced(frame);
  double       buckling = INFINITY;
  if (given.prestress)
  {
    frame         = prestressed(given, parts);
    auto stressed = reduced(frame);
    buckling      = buckling_bound(given, parts, frame, stressed);
    parts         = std::move(stressed);
  }
  JoinedParts joined = join_parts(all_placed(std::move(parts), frame), frame);
  if (given.prestress)
    add_buckling(buckling, BucklingValue::upper_bound, " by motions of the interfaces", joined.facts.statements,
                 joined.facts.facts);
  return completed(frame_service().reduce(joined.matrices, joined_options(frame, joined, options),
                                          named_after("joined parts", progress)),
                   joined);
}

} // namespace gestell::coupling
