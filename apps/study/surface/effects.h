#pragma once

#include "apps/study/surface/response_surface.h"

namespace gestell::apps
{

enum class EffectKind
{
  main,       ///< y(xi_i = +1) - y(xi_i = -1), the others at their centres: 2 b_i
  curvature,  ///< mean of the two less y at the centre: b_ii
  interaction ///< half the change of a variable's main effect from xi_j = -1 to +1: 2 b_ij
};

/// What a variable, or two together, do to an output.
struct Effect
{
  EffectKind  kind = EffectKind::main;
  SurfaceTerm term{};
  std::string name{};          ///< of the term
  double      value      = 0.; ///< in the unit of the output
  double      confidence = 0.; ///< half width of its interval; nan where unknown
  double      share      = 0.; ///< of the output's variance over the range, 0 to 1
};

/**
 * Effects of all terms but the constant, in their order.  Shares: with variables even on [-1, 1] and independent,
 *
 *     Var y = sum b_i^2 / 3 + sum 4 b_ii^2 / 45 + sum b_ij^2 / 9.
 *
 * Source: docs/theory/response_surfaces.md (9) and (10)
 */
std::vector<Effect> effects_of(const ResponseSurface &surface);

const std::string &kind_word(EffectKind kind); ///< "main", "curvature", "interaction"

} // namespace gestell::apps
