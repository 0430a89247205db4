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
  std::string               method, family; ///< "exact, collocation 6" of the "exact" ones
  bool                      own       = true;
  bool                      events    = true; ///< located; else passed over
  int                       model     = 0;    ///< index in WorkPrecision::models
  double                    step      = 0.;   ///< [s], or
  double                    tolerance = 0.;   ///< the other is zero
  double                    error     = std::numeric_limits<double>::quiet_NaN();
  double                    cpu_s     = 0.; ///< of the stepping thread, from the first step to the last
  double                    setup_s   = 0.;
  coupling::IntegrationWork work;
  long                      n_events = 0;
  bool                      resolved = true; ///< the error is at least ten times that of the reference
  std::string               failure;         ///< not empty: no error
  std::string               settings;        ///< lines of a scene's [run]; empty for peers

  double setting() const { return step > 0. ? step : tolerance; }
};

/// One size of the model, with the reference its errors are measured against.
struct WorkModel
{
  int         coordinates = 0, modes = 0;
  std::string reference;            ///< how it was made
  double      reference_error = 0.; ///< by the same measure
  double      reference_cpu_s = 0.;
  /// Distance of this model's reference from that of the largest one: what the modes left out are worth; nan if
  /// unknown.
  double truncation = std::numeric_limits<double>::quiet_NaN();
};

struct WorkPrecision
{
  std::string              scene, description, version, peers; ///< peers: "SUNDIALS 6.4.1" or empty
  std::vector<std::string> signals;
  std::size_t              n_samples = 0;
  double                   begin = 0., end = 0.; ///< [s]
  std::vector<WorkModel>   models;
  std::vector<WorkPoint>   points;
  std::vector<double>      targets; ///< errors that a choice is offered for
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

/// Runs of a model than which no other is both faster and more accurate, the fastest first.  Runs that failed or are
/// not resolved take no part.
std::vector<std::size_t> pareto_front(const WorkPrecision &chart, int model);

/// Of every run whether it is in the front of its model.
std::vector<bool> on_pareto_front(const WorkPrecision &chart);

/// "step 40 µs", "tolerance 1e-05".
std::string setting_words(const WorkPoint &point);

/// CPU time at which a series reaches an error.
struct WorkAtError
{
  double      cpu_s;
  std::size_t point; ///< the coarsest run from which on all are at least that accurate
  bool        bound; ///< cpu_s is that of the coarsest run there is: less might do
};

/// Between the last run above the error and the next finer one, on a straight line in the logarithms; every finer run
/// must stay below.  Nothing if the series does not get there, or if the error is below ten times the reference's own.
std::optional<WorkAtError> work_at_error(const WorkPrecision &chart, const WorkSeries &series, double error);

/// The fastest series at an error, among our own or among the peers.
struct BestSeries
{
  const WorkSeries *series;
  WorkAtError       at;
};
std::optional<BestSeries> best_at_error(const WorkPrecision &chart, const std::vector<WorkSeries> &series, int model,
                                        bool own, double error);

/// chart.csv: every run with all its settings and counts; `pareto` marks the front of its model.
std::string work_precision_csv(const WorkPrecision &chart);

/// What the terminal shows: reference, front, best choices and how they compare with peers.
std::string work_precision_text(const WorkPrecision &chart);

/// chart_settings.toml: the best choice for every target as [run] entries; the first one is in force, the others are
/// comments.
std::string work_precision_settings(const WorkPrecision &chart);

} // namespace gestell::apps
