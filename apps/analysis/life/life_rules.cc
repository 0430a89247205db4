#include "apps/analysis/life/life_rules.h"

#include "fem/values/number_text.h"

#include <stdexcept>

namespace gestell::apps
{
namespace
{

SnCurve curve_of(const CurveRequest &curve, StressKind kind)
{
  constexpr double mega = 1e6; // classes are in MPa
  if (curve.notch_class && curve.standard == "EN 1993-1-9")
    return eurocode_curve(mega * *curve.notch_class, kind, curve.safety);
  if (curve.notch_class)
    return crane_curve(mega * *curve.notch_class, curve.slope.value_or(kind == StressKind::direct ? 3. : 5.), kind,
                       curve.safety);
  if (curve.points.empty())
    return fkm_curve(fkm_material(curve.material), *curve.strength, kind, curve.design_factor * curve.safety);
  std::vector<SnPoint> points;
  for (const auto &[cycles, range] : curve.points)
    points.push_back({cycles, range});
  return table_curve(points, curve.safety, curve.ratio);
}

MeanStress effect_of(const LifeRequest &life, const CurveRequest &curve, StressKind kind, bool has_ratio)
{
  MeanStress effect;
  effect.shear = kind == StressKind::shear;
  if (curve.stress_relieved && effect.shear)
    throw std::invalid_argument("stress_relieved concerns compression, which a shear stress does not have; remove it");
  if (curve.stress_relieved)
    effect.rule = MeanStress::Rule::eurocode;
  if (life.mean_stress == "none" || !has_ratio)
    return effect;
  if (!curve.strength)
    throw std::invalid_argument("mean_stress = \"" + life.mean_stress +
                                "\" needs the tensile strength, such as strength = \"490 MPa\"");
  effect.tensile_strength = *curve.strength;
  effect.rule             = life.mean_stress == "goodman" ? MeanStress::Rule::goodman : MeanStress::Rule::fkm;
  if (effect.rule == MeanStress::Rule::fkm)
    effect.sensitivity = mean_stress_sensitivity(fkm_material(curve.material), *curve.strength, kind);
  return effect;
}

/// The factors of a curve that are not 1, and its ratio.
std::string factors_text(const CurveRequest &curve, const SnCurve &made)
{
  std::string text;
  const auto  add = [&](const std::string &name, double value, double usual)
  { text += value != usual ? ", " + name + " " + short_text(value) : ""; };
  add("design factor", curve.design_factor, 1.);
  add("safety factor", curve.safety, 1.);
  add("damage sum", curve.damage_sum, 1.);
  if (made.ratio)
    text += ", R " + short_text(*made.ratio);
  return text + (curve.stress_relieved ? ", 60 % of compressive parts" : "");
}

} // namespace

DamageRule damage_rule(const LifeRequest &life, const CurveRequest &curve, StressKind kind)
{
  try
  {
    DamageRule rule;
    rule.curve       = curve_of(curve, kind);
    rule.mean_stress = effect_of(life, curve, kind, rule.curve.ratio.has_value());
    rule.miner       = life.miner == "original"     ? Miner::original
                       : life.miner == "elementary" ? Miner::elementary
                                                    : Miner::consequent;
    for (SnPiece &piece : rule.curve.pieces) // failure at D = damage_sum is failure at 1 with fewer cycles
      piece.constant *= curve.damage_sum;
    rule.curve.name += factors_text(curve, rule.curve);
    require_valid(rule.mean_stress, rule.curve.ratio);
    return rule;
  }
  catch (const std::invalid_argument &error)
  {
    throw std::invalid_argument(curve.place + ": " + error.what());
  }
}

StressMeasure measure_of(const LifeRequest &life)
{
  return life.measure == "critical plane" ? StressMeasure::critical_plane : StressMeasure::signed_von_mises;
}

Residue residue_of(const LifeRequest &life)
{
  return life.residue == "half" ? Residue::half : Residue::repeated;
}

} // namespace gestell::apps
