#include "apps/study/results/optimum_scene.h"

namespace gestell::apps
{
namespace
{

std::string in_quotes(const std::string &text)
{
  std::string escaped = "\"";
  for (const char c : text)
    (c == '"' || c == '\\' ? escaped += '\\' : escaped) += c;
  return escaped + '"';
}

} // namespace

std::string optimum_scene(const StudyFile &study, const SceneVariants &variants, const Eigen::VectorXd &levels,
                          const std::filesystem::path &folder)
{
  const auto base =
      std::filesystem::proximate(std::filesystem::absolute(study.scene), std::filesystem::absolute(folder));
  std::string text = "# The optimum of the study " + study.name +
                     ", by gestell study.\nextends = " + in_quotes(base.generic_string()) +
                     "\nname    = " + in_quotes(study.name + "_optimum") + "\n\n";
  for (const auto &[key, value] : variants.changes_at(levels))
    text += key + " = " + value + '\n';
  return text;
}

} // namespace gestell::apps
