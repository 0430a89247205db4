#pragma once

#include "apps/study/file/output_units.h"
#include "apps/study/file/study_file.h"
#include "apps/study/optimum/optimum.h"
#include "apps/study/optimum/row_choice.h"
#include "apps/study/surface/response_surface.h"

#include <optional>

namespace gestell::apps
{

enum class AnalysisOn
{
  surface,
  runs
};

struct SurfaceRequest
{
  SurfaceOptions           options{};
  std::vector<std::string> outputs{}; ///< empty: all
};

struct RobustRequest
{
  AnalysisOn    on    = AnalysisOn::surface;
  int           draws = 10000;
  std::uint64_t seed  = 1;
};

struct OptimiseRequest
{
  AnalysisOn                   on = AnalysisOn::surface;
  OptimumTask                  task{}; ///< outputs by their place in the study; the box -1 to 1
  OptimumOptions               options{};
  bool                         verify = true;
  int                          pareto = 0;
  std::optional<RobustRequest> robust{};
};

/// What is made of the rows of a study.
struct AnalysisRequest
{
  std::optional<SurfaceRequest>  surface{};
  std::optional<OptimiseRequest> optimise{};
  std::optional<RowChoiceTask>   choose{};
  OutputClaims                   claims{};

  bool needs_surfaces() const;
  /// Of so many processes those that its runs can make use of: a search each, or draws.
  int most_side_by_side(int jobs) const;
};

/// [surface], [optimise] and [choose].
/// @throws std::invalid_argument with file and line; for fewer runs than a surface has coefficients, too
AnalysisRequest read_analysis(const StudyFile &study, int n_runs);

} // namespace gestell::apps
