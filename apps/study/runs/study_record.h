#pragma once

#include "apps/study/runs/scene_variants.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace gestell::apps
{

/// What the rows of a study hang on, entry by entry, as study.json keeps it beside them: so that a study is not gone on
/// with after it was changed.  What is made of the rows, [surface] and [optimise], is not part of it.
struct StudyRecord
{
  std::string                        study{};
  int                                n_runs = 0;
  std::map<std::string, std::string> entries{}; ///< "variables.c_P.to": "1080 kN/mm"
  std::vector<std::string>           units{};   ///< of the outputs; empty: no run has told them yet
};

/// Of all that rows depend on: not of scatter, which is about what is made of them.  Files that the scene or a choice
/// of a variable names count by their content, with those that they name (coupling::source_files()).
StudyRecord record_of(const StudyFile &study, const SceneVariants &variants, int n_runs);

/// Nothing if there is none.  @throws std::invalid_argument if it cannot be read
std::optional<StudyRecord> read_record(const std::filesystem::path &file);
void                       write_record(const std::filesystem::path &file, const StudyRecord &record);

/// "variables.c_P.to was "1 kN", is "2 kN"", of each entry that differs.
std::vector<std::string> differences(const StudyRecord &before, const StudyRecord &now);

} // namespace gestell::apps
