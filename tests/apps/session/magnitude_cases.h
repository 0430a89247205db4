#pragma once

#include "apps/scene/build/build_machine.h"
#include "apps/scene/file/expected_values.h"
#include "apps/session/session.h"
#include "apps/templates/scene_templates.h"
#include "tests/support/scene_run.h"
#include "tests/support/scene_text.h"
#include "tests/support/test.h"

#include <cctype>

namespace gestell::tests
{

/// A line of typical_mistakes.txt.
struct TypicalMistake
{
  std::string              line, command, scene;
  std::vector<std::string> keys;    ///< of which a warning has to name one
  std::vector<std::string> entries; ///< as they are mistyped
};

inline std::vector<std::string> split(const std::string &text, const std::string &between)
{
  std::vector<std::string> parts;
  for (std::size_t from = 0; from != std::string::npos;)
  {
    const auto to = text.find(between, from);
    parts.push_back(text.substr(from, to == std::string::npos ? to : to - from));
    from = to == std::string::npos ? to : to + between.size();
  }
  return parts;
}

inline std::vector<TypicalMistake> typical_mistakes()
{
  std::ifstream               file(std::string(GESTELL_SOURCE_DIR) + "/tests/apps/session/typical_mistakes.txt");
  std::vector<TypicalMistake> mistakes;
  for (std::string line; std::getline(file, line);)
  {
    if (line.empty() || line[0] == '#')
      continue;
    const auto parts = split(line, " | ");
    mistakes.push_back(
        {line, parts.at(0), parts.at(1) + ".toml", split(parts.at(3), ", "), {parts.begin() + 4, parts.end()}});
  }
  return mistakes;
}

inline const std::string refused = "refused: ";

/// All that `check`, or `run`, says of a shipped scene with these entries; an error is one sentence, too.
inline std::vector<std::string> sentences_of(const std::string &scene, const std::vector<std::string> &entries,
                                             bool run)
{
  try
  {
    apps::Session session(scene[0] == '/' ? scene : shipped(scene), entries);
    return run ? all_warnings(session.run()) : apps::check_scene(session.scene());
  }
  catch (const std::exception &error)
  {
    return {refused + error.what()};
  }
}

/// What is said of a mistake that is not said of the scene itself.
inline std::vector<std::string> answer_to(const TypicalMistake &mistake, bool run)
{
  const auto               usual = sentences_of(mistake.scene, {}, run);
  std::vector<std::string> answer;
  for (const std::string &sentence : sentences_of(mistake.scene, mistake.entries, run))
    if (std::find(usual.begin(), usual.end(), sentence) == usual.end())
      answer.push_back(sentence);
  return answer;
}

/// A refusal, or a warning that gives a value and the range expected of it; it names a key of the mistake.
inline bool is_answered(const TypicalMistake &mistake, const std::vector<std::string> &answer)
{
  const auto names_key = [&](const std::string &sentence)
  {
    return std::any_of(mistake.keys.begin(), mistake.keys.end(),
                       [&](const std::string &key) { return sentence.find(key) != std::string::npos; });
  };
  return std::any_of(answer.begin(), answer.end(),
                     [&](const std::string &sentence) {
                       return names_key(sentence) &&
                              (apps::compares_magnitudes(sentence) || sentence.rfind(refused, 0) == 0);
                     });
}

/// Scenes of the tutorials, written as their readers write them, and the templates beside them.
inline const test::SceneFolder &folder_of_readers()
{
  static const test::SceneFolder folder;
  return folder;
}

inline std::string text_of_file(const std::filesystem::path &file)
{
  std::ifstream     in(file);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

/// Paths of all scenes that are shipped, templates and those of tutorials included.
inline std::vector<std::string> shipped_scenes()
{
  namespace fs                     = std::filesystem;
  const fs::path           sources = GESTELL_SOURCE_DIR;
  const test::SceneFolder &folder  = folder_of_readers();
  std::vector<std::string> scenes;
  for (const char *place : {"apps/scenes", "apps/scenes/benchmark", "apps/verification/scenes"})
    for (const auto &entry : fs::directory_iterator(sources / place))
      if (entry.path().extension() == ".toml")
        scenes.push_back(entry.path().string());
  const auto write_templates = [&](const std::string &into)
  {
    fs::create_directories(folder.path(into));
    for (const apps::SceneTemplate &kind : apps::scene_templates())
    {
      const apps::SceneTemplate draft = apps::named(kind, kind.kind);
      folder.write(into + "/" + kind.kind + ".geo", draft.frame);
      folder.write(into + "/" + kind.kind + ".toml", draft.scene);
    }
  };
  write_templates("templates");
  for (const apps::SceneTemplate &kind : apps::scene_templates())
    scenes.push_back(folder.path("templates/" + kind.kind + ".toml"));
  for (const auto &page : fs::directory_iterator(sources / "docs/tutorials"))
  {
    const std::string into = page.path().stem().string();
    write_templates(into);
    fs::copy_file(sources / "meshes/press_frame.step", folder.path(into + "/press_frame.step"));
    const std::string text = text_of_file(page.path()), begin = "cat > ", head = ".toml <<'END'\n", end = "\nEND\n";
    for (auto from = text.find(begin); from != std::string::npos; from = text.find(begin, from + 1))
    {
      const auto to = text.find(head, from), last = text.find(end, from);
      if (to == std::string::npos || text.find('\n', from) < to || last == std::string::npos)
        continue;
      const std::string scene = text.substr(to + head.size(), last + 1 - to - head.size());
      const std::string name  = text.substr(from + begin.size(), to - from - begin.size()) + ".toml";
      const std::string path  = folder.write(into + "/" + name, scene);
      if (scene.find("[scene]\n") == std::string::npos) // else a study
        scenes.push_back(path);
    }
  }
  std::sort(scenes.begin(), scenes.end());
  return scenes;
}

inline bool needs_mesh(const std::string &scene)
{
  const auto source = apps::read_scene(scene).frame.source;
  return source == apps::FrameSource::geometry || source == apps::FrameSource::parts;
}

inline std::string name_of_scene(const testing::TestParamInfo<std::string> &info)
{
  std::string name = std::filesystem::path(info.param).parent_path().filename().string() + "_" +
                     std::filesystem::path(info.param).stem().string();
  for (char &letter : name)
    if (!std::isalnum(static_cast<unsigned char>(letter)))
      letter = '_';
  return name;
}

inline std::vector<std::string> magnitudes_of(const std::vector<std::string> &sentences)
{
  std::vector<std::string> found;
  std::copy_if(sentences.begin(), sentences.end(), std::back_inserter(found), apps::compares_magnitudes);
  return found;
}

} // namespace gestell::tests
