#pragma once

#include "apps/output/pictures/projection.h"

#include <utility>
#include <vector>

namespace gestell::apps
{

/// Of two facets the one that is hidden and the one that hides it.
using Hiding = std::pair<int, int>;

struct PaintingOrder
{
  std::vector<int> facets; ///< what is hidden before what hides it, of one face and colour as many in a row as may be
  std::vector<int> ring;   ///< those that have no such order, as they hide each other in rings: the farthest first
};

/// @param seen    numbers of those to be painted
/// @param hiding  between them, as often as it is found; of two that hide each other the more frequent decides
PaintingOrder painting_order(const std::vector<Facet> &facets, const std::vector<int> &seen,
                             std::vector<Hiding> hiding);

} // namespace gestell::apps
