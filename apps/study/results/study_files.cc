#include "apps/study/results/study_files.h"

#include "apps/output/text/write_file.h"
#include "apps/study/report/study_report.h"
#include "apps/study/report/study_tables.h"
#include "apps/study/results/findings_text.h"
#include "apps/study/results/optimum_scene.h"

namespace gestell::apps
{
namespace fs = std::filesystem;
namespace
{

/// Makes the file where there is something to tell.
void write_or_remove(const fs::path &file, bool told, const std::string &text)
{
  if (told)
    write_file(file, text);
  else
    fs::remove(file);
}

} // namespace

Eigen::VectorXd levels_of(const StudyFindings &findings)
{
  Eigen::VectorXd levels(findings.table.variables.size());
  for (Eigen::Index i = 0; i < levels.size(); ++i)
    levels[i] = findings.table.variables[std::size_t(i)].physical(findings.optimum->found.coded[i]);
  return levels;
}

void write_findings(const fs::path &folder, const StudyFile &study, const SceneVariants &variants,
                    const StudyFindings &findings)
{
  const bool surfaces = !findings.surfaces.empty();
  write_or_remove(folder / "surface.csv", surfaces, surface_csv(findings.surfaces));
  write_or_remove(folder / "surface_quality.csv", surfaces, surface_quality_csv(findings.surfaces));
  write_or_remove(folder / "effects.csv", surfaces, effects_csv(findings.surfaces));
  write_or_remove(folder / "front.csv", !findings.front.empty(), front_csv(findings));
  write_or_remove(folder / "robust.csv", !findings.robust.empty(), robust_csv(findings.robust));
  write_or_remove(folder / "optimum.toml", findings.optimum.has_value(),
                  findings.optimum ? optimum_scene(study, variants, levels_of(findings), folder) : "");
  std::string warnings;
  for (const std::string &warning : findings.warnings)
    warnings += "warning: " + warning + '\n';
  const std::string text = warnings + findings_text(findings);
  write_or_remove(folder / "findings.txt", !text.empty(), text);
  const StudyReport report = make_study_report(findings);
  fs::remove_all(folder / "charts");
  if (!report.pictures.empty())
    fs::create_directories(folder / "charts");
  for (const auto &[name, svg] : report.pictures)
    write_file(folder / "charts" / (name + ".svg"), svg);
  write_file(folder / "report.html", report.html);
}

} // namespace gestell::apps
