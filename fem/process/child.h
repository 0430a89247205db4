#pragma once

#include "fem/process/archive.h"
#include "fem/process/reading_limits.h"

#include <functional>
#include <string>

namespace gestell::fem
{

/// Called with the name of the phase that begins and the share done, 0..1 (negative: unknown).
using ChildProgress = std::function<void(const std::string &phase, double share)>;

/// What is done in a child, for its messages.
struct ChildTask
{
  std::string   path;             ///< of the file that is read
  std::string   head;             ///< "<place>: <file>"
  std::string   phase;            ///< the phase that reads, the first; the limits end when another phase is reported
  ReadingLimits limits;           ///< of reading
  bool          alone   = true;   ///< false: no child, see in_one_process()
  std::string   library = "gmsh"; ///< that reads, for messages
  std::string   way_out = "the file is probably damaged: export the model again, or in another format"; ///< of reading
};

/// Whether the environment's GESTELL_ONE_PROCESS is set (not to 0): for debuggers, and where processes are scarce.
bool in_one_process();

/**
 * Runs `work` in a forked copy of this process, in which whatever it does has no effect on this one, and waits.
 *
 * The child has one thread, ends without destructors and exit handlers, writes nothing to standard output, makes its
 * temporary files in a folder that is removed with it, heeds no signals but those that kill, and dies with the thread
 * that made it.  It must not use MPI.
 *
 * @param progress  called here with what `work` tells of its progress, and ten times a second with the same anew; where
 *                  it throws the child is killed and the exception goes on.
 * @return          what `work` returned
 * @throws what `work` throws: std::invalid_argument, std::bad_alloc, and of all others std::runtime_error with their
 *         words.
 * @throws std::invalid_argument with what happened and the way out if the child dies, or its first phase takes more
 *         than its limits.
 */
std::string bytes_from_child(const ChildTask &task, const ChildProgress &progress,
                             const std::function<std::string(const ChildProgress &)> &work);

/// The same for any value that an archive can take; without a child if the task is not alone.
template <typename Value, typename Work>
Value in_child(const ChildTask &task, const ChildProgress &progress, const Work &work)
{
  if (!task.alone)
    return work(progress);
  return value_of<Value>(bytes_from_child(task, progress,
                                          [&](const ChildProgress &reported)
                                          {
                                            Value value = work(reported);
                                            return bytes_of(value);
                                          }));
}

} // namespace gestell::fem
