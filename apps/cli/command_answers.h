#pragma once

#include "apps/session/session.h"
#include "apps/study/report/study_findings.h"
#include "apps/study/runs/study_answer.h"
#include "coupling/frame/frame_cache.h"
#include "coupling/plugin/mesh_report.h"

#include <optional>
#include <string>
#include <vector>

namespace gestell::apps
{

/// Whether the cache contains the frame of a scene, and how the most similar one differs.
struct CacheExplanation
{
  std::string                         scene, key;
  std::optional<coupling::CacheEntry> own{};    ///< cached file with this key
  std::string                         defect{}; ///< why it cannot be used; "": it can, if it exists
  std::optional<coupling::CacheEntry> nearest{};
  std::vector<coupling::Difference>   differences{}; ///< cached and requested values
};

/// Answers of commands as JSON text for answer_with(), all in SI units, docs/reference/json.md.

std::string cache_answer(const std::vector<coupling::CacheEntry> &entries);
std::string explanation_answer(const CacheExplanation &explanation);
std::string frame_answer(const FrameAnswer &answer);
std::string partition_answer(const Partition &partition);
std::string mesh_answer(const coupling::MeshReport &report);
/// @param findings  null: runs are missing, or all failed
std::string study_answer(const StudyAnswer &answer, const StudyFindings *findings);

} // namespace gestell::apps
