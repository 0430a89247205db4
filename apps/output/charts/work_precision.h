#pragma once

#include "coupling/integration/system/time_integrator.h"

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace gestell::apps
{

/// One run of the chart.
struct WorkPoint
{
  std::string               method, family; ///< "exact, collocation 6" of the family "exact"
  bool                      own       = true;
  bool                      events    = true; ///< located; false: skipped
  int                       model     = 0;    ///< index in WorkPrecision::models
  double                    step      = 0.;   ///< [s]; 0 if `tolerance` controls the step
  double                    tolerance = 0.;   ///< 0 if `step` is fixed
  double                    error     = std::numeric_limits<double>::quiet_NaN();
  double                    cpu_s     = 0.; ///< of the stepping thread, from the first step to the last
  double                    setup_s   = 0.;
  coupling::IntegrationWork work;
  long                      n_events = 0;
  bool                      resolved = true; ///< the error is at least ten times that of the reference
  std::string               failure;         ///< not empty: no error
  std::string               settings;        ///< lines of a scene's [run]; empty for other solvers

  double setting() const { return step > 0. ? step : tolerance; }
};

/// One size of the model, with the reference solution of its errors.
struct WorkModel
{
  int         coordinates = 0, modes = 0;
  std::string reference;            ///< how the reference was computed
  double      reference_error = 0.; ///< error of the reference, in the same norm
  double      reference_cpu_s = 0.;
  /// Distance of this model's reference from that of the largest model: the error of the truncated modes; nan if
  /// unknown.
  double truncation = std::numeric_limits<double>::quiet_NaN();
};

struct WorkPrecision
{
  std::string              scene, description, version, peers; ///< peers: other solvers, "SUNDIALS 6.4.1" or empty
  std::vector<std::string> signals;
  std::size_t              n_samples = 0;
  double                   begin = 0., end = 0.; ///< [s]
  std::vector<WorkModel>   models;
  std::vector<WorkPoint>   points;
  std::vector<double>      targets; ///< errors for which the best settings are chosen
  std::vector<std::string> notes;
};

/// Runs of one method on one model, from coarse to fine.
struct WorkSeries
{
  std::string              method, family;
  bool                     own, events;
  int                      model;
  std::vector<std::size_t> points; ///< indices in WorkPrecision::points
};

std::vector<WorkSeries> work_series(const WorkPrecision &chart);

/// Runs of a model that no other run beats in both CPU time and accuracy, the fastest first.  Failed and unresolved
/// runs are skipped.
std::vector<std::size_t> pareto_front(const WorkPrecision &chart, int model);

/// For every run, whether it is on the Pareto front of its model.
std::vector<bool> on_pareto_front(const WorkPrecision &chart);

/// Setting of a run as text: "step 40 µs", "tolerance 1e-05".
std::string setting_words(const WorkPoint &point);

/// CPU time at which a series reaches an error.
struct WorkAtError
{
  double      cpu_s;
  std::size_t point; ///< coarsest run that is this accurate, as are all finer runs
  bool        bound; ///< cpu_s is an upper bound: it is that of the coarsest run of the series
};

/// Interpolates on a straight line in the logarithms between the last run above the error and the next finer one; every
/// finer run must stay below the error.  Empty if the series does not reach the error, or if the error is below ten
/// times that of the reference.
std::optional<WorkAtError> work_at_error(const WorkPrecision &chart, const WorkSeries &series, double error);

/// The fastest series at an error, either of Gestell or of the other solvers.
struct BestSeries
{
  const WorkSeries *series;
  WorkAtError       at;
};
std::optional<BestSeries> best_at_error(const WorkPrecision &chart, const std::vector<WorkSeries> &series, int model,
                                        bool own, double error);

/// chart.csv: every run with all its settings and counts; `pareto` marks the front of its model.
std::string work_precision_csv(const WorkPrecision &chart);

/// Text for the terminal: reference, front, best choices and their comparison with other solvers.
std::string work_precision_text(const WorkPrecision &chart);

/// chart_settings.toml: the best choice for every target as keys of [run]; the first one is active, the others are
/// comments.
std::string work_precision_settings(const WorkPrecision &chart);

} // namespace gestell::apps
