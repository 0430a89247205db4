#pragma once

#include "apps/output/values/error_budget.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/// A model that was tried.
struct SizeRung
{
  double                   mesh_size = 0.;  ///< [m]; 0: not chosen
  std::string              cells;           ///< "tetrahedra", "curved tetrahedra", "swept plates"; empty: not chosen
  int                      coordinates = 0; ///< of the unreduced frame; 0: none
  int                      interface   = 0;
  int                      modes       = -1;          ///< -1: not chosen
  std::string              reduction;                 ///< reduction.method; empty: none
  std::string              method;                    ///< run.method
  double                   step = 0., tolerance = 0.; ///< [s], of the step's control; 0: fixed
  double                   cpu_s = 0.;                ///< from CAD to the end of the run
  std::vector<BudgetEntry> entries;                   ///< by output
  double                   share = 0.; ///< largest error of an output, of what is allowed; infinite: one is not known
  std::string              worst;      ///< what takes most of it: \"mesh of F_P.max\"
};

struct SizeProof
{
  std::string output, unit;
  double      value = 0., finer = 0.;
};

/// What a search will have taken when it has judged one more model.
struct SizeForecast
{
  double coordinates = 0.; ///< of that model
  int    modes       = -1;
  double model_cpu_s = 0.; ///< from CAD to the end of its run
  double spent_cpu_s = 0.; ///< so far
  double cpu_s       = 0.; ///< with the model, what judges it and the last run

  double runs() const { return cpu_s / model_cpu_s; } ///< of it
};

/// The way to the smallest model whose errors stay within a tolerance.
struct SizeResult
{
  double                   tolerance = 0.;
  std::vector<SizeRung>    ladder; ///< in the order they were tried
  std::size_t              chosen = 0;
  bool                     met    = false; ///< the chosen one stays within the tolerance
  std::string              stopped;        ///< why nothing finer was tried, if it is not
  std::vector<SizeProof>   proof;          ///< chosen model against one that is finer in everything
  std::string              finer;          ///< what that was
  std::vector<std::string> left_out, missing;
  std::vector<std::string> unasked;    ///< what may be left out or is missing perhaps, which costs too much to ask
  SizeForecast             forecast;   ///< the last one
  double                   cpu_s = 0.; ///< of the whole search

  /// Every model about the chosen one, where all were asked for; `share` is the largest difference to the finer model
  /// of the proof, of what is allowed, `worst` the output that has it.
  std::vector<SizeRung> all;
  std::size_t           chosen_of_all = 0;

  /// Of the chosen model with its preparation, that the search took.
  double runs() const { return cpu_s / ladder.at(chosen).cpu_s; }
};

} // namespace gestell::apps
