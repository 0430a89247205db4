#include "apps/reference/study_tables.h"

#include "apps/study/file/study_keys.h"

namespace gestell::apps
{

const std::vector<DeclaredTable> &study_tables()
{
  static const std::vector<DeclaredTable> tables = {
      {"study", "", "", "What stands above all tables of a study, and these.", "", study_keys(), {}},
      {"study.scene", "[scene]", "", "The scene that a study varies.", "", study_scene_keys(), {}},
      {"study.variables", "[variables.NAME]", "", "What a study varies.", "", study_variable_keys(), {}},
      {"study.design", "[design]", "", "Which runs a study makes.", "", study_design_keys(), {}},
      {"study.surface", "[surface]", "", "Response surfaces of the outputs.", "", study_surface_keys(), {}},
      {"study.optimise", "[optimise]", "", "What a study looks for.", "", study_optimise_keys(), {}},
      {"study.choose", "[choose]", "", "Which of the runs of a study is the best.", "", study_choose_keys(), {}},
      {"study.goals",
       "[optimise.goals.OUTPUT]",
       "",
       "An output that shall be small or large.",
       "",
       study_goal_keys(),
       {}},
      {"study.limits", "[optimise.limits.OUTPUT]", "", "What an output must keep to.", "", study_limit_keys(), {}}};
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
