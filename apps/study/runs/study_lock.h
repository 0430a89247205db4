#pragma once

#include "apps/output/folder_lock.h"
#include "apps/study/runs/study_folder.h"

namespace gestell::apps
{

/**
 * Holds the folder of a study while it lives: one call at a time makes or merges all of it, shares of it are made side
 * by side.
 */
class StudyLock : public FolderLock
{
public:
  /// @throws std::invalid_argument with the process that holds the folder
  StudyLock(const std::filesystem::path &folder, const StudyShare &share);
};

} // namespace gestell::apps
