#include "apps/study/runs/study_lock.h"

namespace gestell::apps
{

StudyLock::StudyLock(const std::filesystem::path &folder, const StudyShare &share)
    : FolderLock(folder, share.is_whole() ? Kind::alone : Kind::beside_others,
                 share.is_whole() ? "is making a study there" : "is making a share of a study there",
                 ", or give another folder with -o")
{
}

} // namespace gestell::apps
