#pragma once

#include "apps/output/pictures/facet.h"

#include <vector>

namespace gestell::apps
{

struct PaintingOrder
{
  std::vector<int> facets; ///< what is hidden before what hides it, of one face and colour as many in a row as may be
  std::vector<int> ring;   ///< those that have no such order, as they hide each other in rings: the farthest first
};

/// @param seen    numbers of those to be painted
/// @param hiding  sorted by the hidden facet, then by the other, each pair once; of two that hide each other the one
/// that
///                does so at more points decides
PaintingOrder painting_order(const std::vector<Facet> &facets, const std::vector<int> &seen,
                             const HidingCounts &hiding);

} // namespace gestell::apps
