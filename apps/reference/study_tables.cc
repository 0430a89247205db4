#include "apps/reference/study_tables.h"

#include "apps/study/file/study_keys.h"

namespace gestell::apps
{

const std::vector<DeclaredTable> &study_tables()
{
  static const std::vector<DeclaredTable> tables = {
      {"study", "", "", "Top-level keys of a study.", "", study_keys(), {}},
      {"study.scene", "[scene]", "", "Scene that the study varies.", "", study_scene_keys(), {}},
      {"study.variables", "[variables.NAME]", "", "Variable of the study.", "", study_variable_keys(), {}},
      {"study.design", "[design]", "", "Design: the runs of the study.", "", study_design_keys(), {}},
      {"study.surface", "[surface]", "", "Response surfaces of the outputs.", "", study_surface_keys(), {}},
      {"study.optimise", "[optimise]", "", "Optimisation.", "", study_optimise_keys(), {}},
      {"study.choose", "[choose]", "", "Selection of the best run.", "", study_choose_keys(), {}},
      {"study.goals",
       "[optimise.goals.OUTPUT]",
       "",
       "Goal: output to be minimised or maximised.",
       "",
       study_goal_keys(),
       {}},
      {"study.limits", "[optimise.limits.OUTPUT]", "", "Limit of an output.", "", study_limit_keys(), {}}};
  return tables;
}

const std::vector<DeclaredTable> &told_tables()
{
  static const std::vector<DeclaredTable> all = []
  {
    std::vector<DeclaredTable> tables = declared_tables();
    tables.insert(tables.end(), study_tables().begin(), study_tables().end());
    return tables;
  }();
  return all;
}

} // namespace gestell::apps
