#pragma once

#include "apps/output/describe/described.h"
#include "apps/output/values/error_budget.h"

#include <cmath>
#include <string>
#include <vector>

namespace gestell::apps
{

/// A model tried by the search.
struct SizeRung
{
  double                   mesh_size = 0.;  ///< [m]; 0: not chosen
  std::string              cells;           ///< "tetrahedra", "curved tetrahedra", "swept plates"; empty: not chosen
  int                      coordinates = 0; ///< DOFs of the unreduced frame; 0: none
  int                      interface   = 0;
  int                      modes       = -1;          ///< -1: not chosen
  std::string              reduction;                 ///< reduction.method; empty: none
  std::string              method;                    ///< run.method
  double                   step = 0., tolerance = 0.; ///< [s], of the step-size control; 0: fixed
  double                   cpu_s = 0.;                ///< from CAD to the end of the run
  std::vector<BudgetEntry> entries;                   ///< by output
  double                   share = 0.; ///< largest error relative to the allowed one; infinite: one is unknown
  std::string              worst;      ///< largest contribution to it: \"mesh of F_P.max\"
};

struct SizeProof
{
  std::string output, unit;
  double      value = 0., finer = 0.;
};

/// Predicted cost of the search including one more model.
struct SizeForecast
{
  double coordinates = 0.; ///< DOFs of that model
  int    modes       = -1;
  double model_cpu_s = 0.; ///< from CAD to the end of its run
  double spent_cpu_s = 0.; ///< so far
  double cpu_s       = 0.; ///< with the model, its error estimate and the last run

  double runs() const { return cpu_s / model_cpu_s; } ///< cost in runs of that model
};

/// Search for the smallest model whose errors are within a tolerance.
struct SizeResult
{
  double                   tolerance = 0.;
  std::vector<SizeRung>    ladder; ///< in the order they were tried
  std::size_t              chosen = 0;
  bool                     met    = false; ///< the chosen model is within the tolerance
  std::string              stopped;        ///< if not: why nothing finer was tried
  std::vector<SizeProof>   proof;          ///< chosen model against one that is finer in everything
  std::string              finer;          ///< description of the finer model
  std::vector<std::string> left_out, missing;
  std::vector<std::string> skipped;    ///< models without a frame, each with the reason
  std::vector<std::string> unasked;    ///< omissions and additions not tested because of their cost
  SizeForecast             forecast;   ///< the latest one
  double                   cpu_s = 0.; ///< of the whole search

  /// All models around the chosen one, if an exhaustive search was requested.  `share` is the largest difference to the
  /// finer model of the verification run relative to the allowed error, `worst` the output with this difference.
  std::vector<SizeRung> all;
  std::size_t           chosen_of_all = 0;

  /// Cost of the search in runs of the chosen model, preparation included.
  double runs() const { return cpu_s / ladder.at(chosen).cpu_s; }
};

/// The chosen model.
struct ChosenRung
{
  std::size_t number = 0; ///< from 1 on
  SizeRung    rung{};
};

/// Errors of an output without their assumptions.
struct OutputErrors
{
  BudgetEntry entry{};
};

template <class Visitor>
void describe(Visitor &v, const OutputErrors &x)
{
  describe_errors(v, x.entry);
}

template <class Visitor>
void describe(Visitor &v, const SizeRung &x)
{
  std::vector<std::pair<std::string, OutputErrors>> outputs;
  for (const BudgetEntry &entry : x.entries)
    outputs.push_back({entry.output, {entry}});
  v("mesh_size", x.mesh_size > 0. ? std::optional(x.mesh_size) : std::nullopt, "m", "null: not chosen");
  v("sides", unless_empty(x.cells), "", "kind of elements; null: not chosen");
  v("coordinates", x.coordinates, "", "DOFs of the unreduced frame");
  v("interface", x.interface, "", "interface DOFs q1 of the frame");
  v("modes", x.modes >= 0 ? std::optional(x.modes) : std::nullopt, "", "null: not chosen");
  v("reduction", x.reduction.empty() ? std::nullopt : std::optional(x.reduction), "", "null: none");
  v("method", x.method, "", "method of integration");
  v("step", x.step, "s", "of the integration");
  v("tolerance", x.tolerance, "1", "tolerance of the step control; 0: fixed step");
  v("cpu_s", x.cpu_s, "s", "CPU time from CAD to the end of the run");
  v("share", x.share, "1", "largest ratio of error to allowed error; null: unknown");
  v("worst", x.worst, "", "largest contribution to this error");
  v("outputs", outputs, "", "errors of each output");
}

template <class Visitor>
void describe(Visitor &v, const ChosenRung &x)
{
  v("rung", x.number, "", "number of the model");
  describe(v, x.rung);
}

template <class Visitor>
void describe(Visitor &v, const SizeProof &x)
{
  v("value", x.value, x.unit, "of the chosen model");
  v("finer", x.finer, x.unit, "of the finer model");
  v("difference", std::abs(x.finer - x.value), x.unit, "difference of the two");
}

template <class Visitor>
void describe(Visitor &v, const SizeResult &x)
{
  v("tolerance", x.tolerance, "1", "relative tolerance of each output");
  v("met", x.met, "", "whether the chosen model is within the tolerance");
  v("stopped", unless_empty(x.stopped), "", "reason why no finer model was tried; null: the tolerance is met");
  v("chosen", x.ladder.empty() ? ChosenRung() : ChosenRung{x.chosen + 1, x.ladder.at(x.chosen)}, "",
    "the chosen model");
  v("proof", by_name(x.proof, &SizeProof::output), "",
    "verification: outputs compared with those of a model that is finer in every respect");
  v("finer", x.finer, "", "description of the finer model");
  v("left_out", x.left_out, "", "parts of the scene that could be omitted");
  v("missing", x.missing, "", "effects that the model may lack");
  v("skipped", x.skipped, "", "models whose mesh or frame could not be made, with the reason");
  v("unasked", x.unasked, "", "variants not examined because of their cost");
  v("cost",
    std::vector<std::pair<std::string, double>>{
        {"cpu_s", x.cpu_s}, {"runs", x.ladder.empty() ? 0. : x.runs()}, {"forecast_cpu_s", x.forecast.cpu_s}},
    "", "cost of the search: CPU time [s], number of equivalent runs of the chosen model, and forecast [s]");
}

} // namespace gestell::apps
