#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gestell::apps
{

/// Part of an S-N curve: N = constant / range^slope for ranges from `from` up to where the piece before begins.
struct SnPiece
{
  double slope    = 3.;
  double constant = 0.; ///< N range^slope [Pa^slope]
  double from     = 0.; ///< range [Pa]

  double damage(double range) const; ///< of one cycle: range^slope / constant
};

/**
 * Cycles N to failure as a function of the stress range (max - min), straight lines in log-log.
 * Pieces by descending range; the first has no upper end. Below `cut_off()` a cycle does no damage by itself.
 */
struct SnCurve
{
  std::string           name;
  std::vector<SnPiece>  pieces;
  std::optional<double> ratio; ///< R = min/max of the cycles it was measured with; none: it does not depend on the mean

  double cut_off() const { return pieces.back().from; } ///< [Pa]; 0: none
  /// Damage 1/N of a cycle; below the cut-off zero or, `prolonged`, that of the last line.
  double damage(double range, bool prolonged = false) const;
  /// Slopes grow as ranges fall: then damage(range) is the smallest of its prolonged lines.
  bool concave() const;
};

enum class StressKind
{
  direct,
  shear
};

/**
 * EN 1993-1-9:2005, 7.1: detail category = range [Pa] of 2e6 cycles.
 *   direct: 160 to 36 MPa, m = 3 to 5e6 cycles, m = 5 to the cut-off at 1e8;
 *   shear:  100 and 80 MPa, m = 5 to the cut-off at 1e8.
 * @param gamma  partial factor gamma_Mf, divides ranges; > 0
 * @throws std::invalid_argument: no such category (with the nearest one), gamma
 */
SnCurve eurocode_curve(double category, StressKind kind, double gamma);

/**
 * EN 13001-3-1, annex D: notch class = range [Pa] of 2e6 cycles, 355 to 28 MPa; one line, no cut-off.
 * @param slope  of the detail: 3 for welds, 5 for plain material and for shear
 * @param gamma  fatigue strength specific resistance factor gamma_mf, > 0
 * @throws std::invalid_argument: no such class (with the nearest one), gamma
 */
SnCurve crane_curve(double notch_class, double slope, StressKind kind, double gamma);

/// Groups of material of the FKM guideline.
struct FkmMaterial
{
  std::string_view name;
  double           fatigue_ratio; ///< f_W: amplitude of the fatigue limit at R = -1 over the tensile strength
  double           shear_ratio;   ///< f_tau: of the limit in shear over that in tension
  double           a_M, b_M;      ///< mean stress sensitivity M = a_M R_m / 1000 MPa + b_M
  bool             second_knee;   ///< slope 15, 25 in shear, from 1e6 to 1e8 cycles (aluminium, austenitic steel)
};
const std::vector<FkmMaterial> &fkm_materials();
/// @throws std::invalid_argument: no such material, with the names
const FkmMaterial &fkm_material(std::string_view name);
/// M >= 0 for a tensile strength [Pa]; of shear stress f_tau M.
double mean_stress_sensitivity(const FkmMaterial &material, double tensile_strength, StressKind kind);

/**
 * FKM guideline (local stresses, unwelded): limit 2 f_W R_m / K at 1e6 cycles, R = -1; m = 5 above it (8 in shear).
 * @param tensile_strength  R_m [Pa], > 0
 * @param design_factor     K: roughness, size, surface treatment, safety; >= what makes a finite limit, > 0
 * @throws std::invalid_argument
 */
SnCurve fkm_curve(const FkmMaterial &material, double tensile_strength, StressKind kind, double design_factor);

struct SnPoint
{
  double cycles = 0.;
  double range  = 0.; ///< [Pa]
};
/**
 * Through points, N ascending, ranges strictly falling; the first line is prolonged to larger ranges, the last point is
 * the cut-off.
 * @throws std::invalid_argument: fewer than two points, not finite or positive, a curve that does not fall (with its
 *         point), a line of slope below 1
 */
SnCurve table_curve(const std::vector<SnPoint> &points, double gamma, std::optional<double> ratio);

} // namespace gestell::apps
