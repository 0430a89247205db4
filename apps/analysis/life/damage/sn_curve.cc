#include "apps/analysis/life/damage/sn_curve.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace gestell::apps
{

namespace
{

constexpr double megapascal   = 1e6; // [Pa]
constexpr double class_cycles = 2e6; // cycles of a class, EN 1993-1-9 and EN 13001-3-1

/// EN 1993-1-9:2005, figures 7.1 and 7.2 [MPa].
const std::vector<double> &eurocode_classes(StressKind kind)
{
  static const std::vector<double> direct{160., 140., 125., 112., 100., 90., 80., 71., 63., 56., 50., 45., 40., 36.};
  static const std::vector<double> shear{100., 80.};
  return kind == StressKind::direct ? direct : shear;
}

/// EN 13001-3-1, annex D [MPa]: each class is about 1.12 of the next.
const std::vector<double> &crane_classes()
{
  static const std::vector<double> classes{355., 315., 280., 250., 225., 200., 180., 160., 140., 125., 112., 100.,
                                           90.,  80.,  71.,  63.,  56.,  50.,  45.,  40.,  36.,  32.,  28.};
  return classes;
}

std::string text_of(double x)
{
  std::ostringstream text;
  text << x;
  return text.str();
}

double power_of(double x, double m)
{
  return m == 3. ? x * x * x : m == 5. ? (x * x) * (x * x) * x : std::pow(x, m);
}

void require_positive_factor(double gamma, const std::string &name)
{
  if (!(gamma > 0.) || !std::isfinite(gamma))
    throw std::invalid_argument("the " + name + " is " + text_of(gamma) + "; give a positive number.");
}

void require_class(double value, const std::vector<double> &classes, const std::string &what)
{
  const double sought  = value / megapascal;
  double       nearest = classes.front();
  for (const double c : classes)
    if (std::abs(c - sought) < std::abs(nearest - sought))
      nearest = c;
  if (!(std::abs(nearest - sought) <= 1e-9 * nearest)) // rounding of units
    throw std::invalid_argument(what + " has no class " + text_of(sought) + " MPa; the nearest one is " +
                                text_of(nearest) + " MPa; a factor on it is 'safety'.");
}

/// Line of slope m through (cycles, range).
SnPiece line_through(double cycles, double range, double slope, double from)
{
  return {slope, cycles * power_of(range, slope), from};
}

/// The next line begins where the last one ends, and ends at `cycles`.
void continue_to(SnCurve &curve, double slope, double cycles)
{
  const double knee  = curve.pieces.back().from;
  const double start = curve.pieces.back().constant / power_of(knee, curve.pieces.back().slope);
  curve.pieces.push_back(line_through(start, knee, slope, knee * std::pow(start / cycles, 1. / slope)));
}

std::string of_kind(StressKind kind)
{
  return kind == StressKind::direct ? " for direct stress" : " for shear stress";
}

} // namespace

double SnPiece::damage(double range) const
{
  return power_of(range, slope) / constant;
}

double SnCurve::damage(double range, bool prolonged) const
{
  for (const SnPiece &piece : pieces)
    if (range >= piece.from)
      return piece.damage(range);
  return prolonged ? pieces.back().damage(range) : 0.;
}

bool SnCurve::concave() const
{
  return std::is_sorted(pieces.begin(), pieces.end(),
                        [](const SnPiece &a, const SnPiece &b) { return a.slope < b.slope; });
}

SnCurve eurocode_curve(double category, StressKind kind, double gamma)
{
  require_class(category, eurocode_classes(kind), "EN 1993-1-9" + of_kind(kind));
  require_positive_factor(gamma, "partial factor gamma_Mf");
  const double range = category / gamma;
  SnCurve      curve{"EN 1993-1-9, detail category " + text_of(category / megapascal) + of_kind(kind), {}, {}};
  const auto   at = [&](double cycles, double slope) { return range * std::pow(class_cycles / cycles, 1. / slope); };
  if (kind == StressKind::direct)
  {
    curve.pieces = {line_through(class_cycles, range, 3., at(5e6, 3.))};
    continue_to(curve, 5., 1e8);
  }
  else
    curve.pieces = {line_through(class_cycles, range, 5., at(1e8, 5.))};
  return curve;
}

SnCurve crane_curve(double notch_class, double slope, StressKind kind, double gamma)
{
  require_class(notch_class, crane_classes(), "EN 13001-3-1" + of_kind(kind));
  require_positive_factor(gamma, "specific resistance factor gamma_mf");
  if (slope != 3. && slope != 5.)
    throw std::invalid_argument("EN 13001-3-1 has no slope " + text_of(slope) + "; give 3 or 5.");
  return {"EN 13001-3-1, notch class " + text_of(notch_class / megapascal) + ", slope " + text_of(slope) +
              of_kind(kind),
          {line_through(class_cycles, notch_class / gamma, slope, 0.)},
          {}};
}

const std::vector<FkmMaterial> &fkm_materials()
{
  // FKM guideline, 6th edition 2012, 4.2.1 (f_W, f_tau), 4.4.2 (a_M, b_M), 4.4.3 (second knee)
  static const std::vector<FkmMaterial> materials{
      {"steel", 0.45, 0.577, 0.35, -0.1, false},
      {"forged steel", 0.40, 0.577, 0.35, -0.1, false},
      {"case-hardened steel", 0.40, 0.577, 0.35, -0.1, false},
      {"stainless steel", 0.40, 0.577, 0.35, -0.1, true},
      {"cast steel", 0.34, 0.577, 0.35, 0.05, false},
      {"ductile cast iron", 0.34, 0.65, 0.35, 0.08, false},
      {"malleable cast iron", 0.30, 0.75, 0.35, 0.13, false},
      {"grey cast iron", 0.34, 1.0, 0., 0.5, false},
      {"wrought aluminium", 0.30, 0.577, 1.0, -0.04, true},
      {"cast aluminium", 0.30, 0.75, 1.0, 0.2, true},
  };
  return materials;
}

const FkmMaterial &fkm_material(std::string_view name)
{
  std::string names;
  for (const FkmMaterial &material : fkm_materials())
  {
    if (material.name == name)
      return material;
    names += (names.empty() ? "" : ", ") + std::string(material.name);
  }
  throw std::invalid_argument("the FKM guideline has no material '" + std::string(name) + "'; give one of " + names +
                              ".");
}

double mean_stress_sensitivity(const FkmMaterial &material, double tensile_strength, StressKind kind)
{
  const double M = std::max(0., material.a_M * 1e-3 * tensile_strength / megapascal + material.b_M);
  return kind == StressKind::direct ? M : material.shear_ratio * M;
}

SnCurve fkm_curve(const FkmMaterial &material, double tensile_strength, StressKind kind, double design_factor)
{
  if (!(tensile_strength > 0.) || !std::isfinite(tensile_strength))
    throw std::invalid_argument("the tensile strength is " + text_of(tensile_strength / megapascal) +
                                " MPa; give a positive number.");
  require_positive_factor(design_factor, "design factor");
  const bool   direct = kind == StressKind::direct;
  const double limit =
      2. * material.fatigue_ratio * (direct ? 1. : material.shear_ratio) * tensile_strength / design_factor;
  SnCurve curve{"FKM, " + std::string(material.name) + ", R_m " + text_of(tensile_strength / megapascal) + " MPa" +
                    of_kind(kind),
                {line_through(1e6, limit, direct ? 5. : 8., limit)},
                -1.};
  if (material.second_knee)
    continue_to(curve, direct ? 15. : 25., 1e8);
  return curve;
}

SnCurve table_curve(const std::vector<SnPoint> &points, double gamma, std::optional<double> ratio)
{
  require_positive_factor(gamma, "partial factor of the S-N curve");
  if (points.size() < 2)
    throw std::invalid_argument("the S-N curve has " + std::to_string(points.size()) +
                                " points; give at least two of cycles and stress range.");
  SnCurve curve{"S-N curve of " + std::to_string(points.size()) + " points", {}, ratio};
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const auto &[cycles, range] = points[i];
    const std::string point = "point " + std::to_string(i + 1) + " of the S-N curve (" + text_of(cycles) + " cycles, " +
                              text_of(range / megapascal) + " MPa)";
    if (!(cycles > 0. && range > 0.) || !std::isfinite(cycles) || !std::isfinite(range))
      throw std::invalid_argument(point + " is not positive and finite.");
    if (i == 0)
      continue;
    const auto &before = points[i - 1];
    if (!(cycles > before.cycles && range < before.range))
      throw std::invalid_argument(point + " does not fall from the point before it (" + text_of(before.cycles) +
                                  " cycles, " + text_of(before.range / megapascal) +
                                  " MPa); give more cycles and a smaller range.");
    const double slope = std::log(cycles / before.cycles) / std::log(before.range / range);
    if (slope < 1.)
      throw std::invalid_argument(point + " is reached with the slope m = " + text_of(slope) +
                                  "; fatigue has m >= 1, usually 3 to 15.");
    curve.pieces.push_back(line_through(cycles, range / gamma, slope, range / gamma));
  }
  return curve;
}

} // namespace gestell::apps
