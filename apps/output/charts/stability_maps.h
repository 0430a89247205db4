#pragma once

#include "apps/output/text/csv.h"
#include "coupling/integration/stability/overshoot.h"
#include "coupling/integration/stability/stability.h"
#include "coupling/simulation/checks/stability_guard.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/// A method in the maps: exact propagation appears with its element forces, since its base modes have no error.
struct MappedMethod
{
  coupling::MethodOptions options;
  coupling::Spring        spring = coupling::Spring::base;
  std::string             name;
};

/// Methods that share a panel of a chart.
struct MethodFamily
{
  std::string               title;
  std::vector<MappedMethod> methods;
};

/// Every method of Gestell, with its usual parameters and with those that show how it fails.
std::vector<MethodFamily> method_families();

/// One method at one damping ratio, over omega h.
struct StabilityMap
{
  std::string                           method;
  int                                   family;
  double                                zeta;
  std::vector<double>                   omega_h;
  std::vector<coupling::StepProperties> step;
  std::vector<coupling::Overshoot>      displaced; ///< from an initial displacement
};

/// Maps of `families` for omega h from 1e-2 to 1e3, a hundred points a decade.
std::vector<StabilityMap> stability_maps(const std::vector<MethodFamily> &families, const std::vector<double> &zetas);

struct MappedInterval
{
  std::string                method;
  double                     zeta;
  coupling::UnstableInterval interval;
};

template <class Visitor>
void describe(Visitor &v, const MappedInterval &x)
{
  v("method", x.method, "", "with its parameters");
  v("damping_ratio", x.zeta, "1", "of the mode");
  v("from_omega_h", x.interval.from, "1", "start of the interval; 0: grows however small the step");
  v("to_omega_h", x.interval.to, "1", "its end; null: none");
  v("growth_per_step", x.interval.growth, "1", "largest in the interval");
  v("at_omega_h", x.interval.at_omega_h, "1", "where it is largest");
}
std::vector<MappedInterval> unstable_maps(const std::vector<MethodFamily> &families, const std::vector<double> &zetas);

/// stability_maps.csv
CsvTable maps_csv(const std::vector<StabilityMap> &maps);

struct NamedSvg
{
  std::string name, svg; ///< file name without extension
};

/// For one damping ratio: spectral radius, period error, numerical damping, overshoot; `modes` are marked.
std::vector<NamedSvg> stability_charts(const std::vector<MethodFamily> &families, const std::vector<StabilityMap> &maps,
                                       double zeta, const std::vector<coupling::ModeAccuracy> &modes);

} // namespace gestell::apps
