#pragma once

#include "fem/process/archive.h"
#include "fem/process/reading_limits.h"

#include <functional>
#include <stdexcept>
#include <string>

namespace gestell::fem
{

/// Called with the name of the phase that begins and the completed share, 0..1 (negative: unknown).
using ChildProgress = std::function<void(const std::string &phase, double share)>;

/// Description of the work in a child, for its messages.
struct ChildTask
{
  std::string   path;             ///< of the file that is read; empty: none, and way_out always holds
  std::string   head;             ///< "<place>: <file>"
  std::string   phase;            ///< the first phase, which reads; the limits end when another phase is reported
  ReadingLimits limits;           ///< of reading
  bool          alone   = true;   ///< false: no child, see in_one_process()
  std::string   library = "gmsh"; ///< reading library, for messages
  std::string   way_out = "the file is probably damaged: export the model again, or in another format"; ///< remedy
};

/// A fault ended the child after its first phase, such as a segmentation fault.
class ChildFault : public std::invalid_argument
{
public:
  using std::invalid_argument::invalid_argument;
};

/// Whether the environment variable GESTELL_ONE_PROCESS is set (not to 0): for debuggers and limited process counts.
bool in_one_process();

/**
 * Runs `work` in a forked child, isolated from this process, and waits.
 *
 * The child has one thread, ends without destructors and exit handlers, writes nothing to standard output, creates
 * temporary files in a folder that is removed with it, ignores signals except those that kill, and dies with the thread
 * that created it.  It must not use MPI.
 *
 * @param progress  called here with the progress of `work`, repeated ten times a second; if it throws, the child is
 * killed and the exception propagates.
 * @return          the result of `work`
 * @throws the exceptions of `work`: std::invalid_argument, std::bad_alloc, and for all others std::runtime_error with
 * their message.
 * @throws std::invalid_argument with cause and remedy if the child dies, or its first phase exceeds its limits;
 * ChildFault for a fault after its first phase.
 */
std::string bytes_from_child(const ChildTask &task, const ChildProgress &progress,
                             const std::function<std::string(const ChildProgress &)> &work);

/// The same for any archivable value; without a child if the task is not alone.
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
