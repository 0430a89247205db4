#include "apps/study/surface/effects.h"

#include <array>
#include <cmath>

namespace gestell::apps
{
namespace
{

EffectKind kind_of(const SurfaceTerm &term)
{
  return term.degree() == 1 ? EffectKind::main : term.is_square() ? EffectKind::curvature : EffectKind::interaction;
}

/// Effect per coefficient, and variance of the term on [-1, 1].
double factor_of(EffectKind kind)
{
  return kind == EffectKind::curvature ? 1. : 2.;
}
double variance_of(EffectKind kind)
{
  return kind == EffectKind::main ? 1. / 3. : kind == EffectKind::curvature ? 4. / 45. : 1. / 9.;
}

} // namespace

std::vector<Effect> effects_of(const ResponseSurface &surface)
{
  std::vector<Effect> effects;
  double              variance = 0.;
  for (int j = 1; j < static_cast<int>(surface.terms.size()); ++j)
  {
    const EffectKind kind = kind_of(surface.terms[j]);
    const double     b    = surface.coefficients(j);
    effects.push_back({kind, surface.terms[j], surface.term_name(j), factor_of(kind) * b,
                       factor_of(kind) * surface.confidence(j), variance_of(kind) * b * b});
    variance += effects.back().share;
  }
  const double rounding = 1e-12 * std::abs(surface.coefficients(0)); // of an output that does not change
  for (Effect &effect : effects)
    effect.share = variance > rounding * rounding ? effect.share / variance : 0.;
  return effects;
}

const std::string &kind_word(EffectKind kind)
{
  static const std::array<std::string, 3> words = {"main", "curvature", "interaction"};
  return words[static_cast<std::size_t>(kind)];
}

} // namespace gestell::apps
