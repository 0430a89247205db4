#include "apps/study/results/study_files.h"

#include "apps/output/folder/writing.h"
#include "apps/scene/file/extending_scene.h"
#include "apps/study/report/study_report.h"
#include "apps/study/report/study_tables.h"
#include "apps/study/results/findings_text.h"

namespace gestell::apps
{
namespace fs = std::filesystem;
namespace
{

struct Table
{
  const char *name;
  bool        reported; ///< there is something to tell
  std::string text;
};

} // namespace

Eigen::VectorXd levels_of(const StudyFindings &findings)
{
  Eigen::VectorXd levels(findings.table.variables.size());
  for (Eigen::Index i = 0; i < levels.size(); ++i)
    levels[i] = findings.table.variables[std::size_t(i)].physical(findings.optimum->found.coded[i]);
  return levels;
}

std::string optimum_scene(const StudyFile &study, const SceneVariants &variants, const Eigen::VectorXd &levels,
                          const fs::path &folder)
{
  auto      changes = variants.changes_at(levels);
  SceneNode name;
  name.type = SceneNode::Type::text;
  name.text = study.name + "_optimum";
  add_change(changes, "name", name);
  return extending_scene("The optimum of the study " + study.name + ", by gestell study.", study.scene, changes,
                         folder);
}

void write_findings(const fs::path &folder, const StudyFile &study, const SceneVariants &variants,
                    const StudyFindings &findings)
{
  const bool  surfaces = !findings.surfaces.empty();
  std::string text;
  for (const std::string &warning : findings.warnings)
    text += "warning: " + warning + '\n';
  text += findings_text(findings);
  const StudyReport report   = make_study_report(findings);
  const Table       tables[] = {{"surface.csv", surfaces, surface_csv(findings.surfaces)},
                                {"surface_quality.csv", surfaces, surface_quality_csv(findings.surfaces)},
                                {"effects.csv", surfaces, effects_csv(findings.surfaces)},
                                {"front.csv", !findings.front.empty(), front_csv(findings)},
                                {"robust.csv", !findings.robust.empty(), robust_csv(findings.robust)},
                                {"optimum.toml", findings.optimum.has_value(),
                           findings.optimum ? optimum_scene(study, variants, levels_of(findings), folder) : ""},
                                {"findings.txt", !text.empty(), text}};
  OwnFolder         own(folder);
  own.remove_all([](const std::string &name) { return has_form(name, "charts/*"); });
  for (const Table &table : tables)
    if (!table.reported)
      own.remove(table.name);
  write_or_rescue(folder,
                  [&](Writing &writing)
                  {
                    for (const Table &table : tables)
                      if (table.reported)
                        writing.write(table.name, table.text);
                    writing.write("report.html", report.html);
                    for (const auto &[name, svg] : report.pictures)
                      writing.write("charts/" + name + ".svg", svg);
                  });
}

const std::vector<std::string> &study_names()
{
  static const std::vector<std::string> names = {"surface.csv", "surface_quality.csv", "effects.csv",  "front.csv",
                                                 "robust.csv",  "optimum.toml",        "findings.txt", "report.html",
                                                 "charts/",     "optimum_runs.csv"};
  return names;
}

} // namespace gestell::apps
