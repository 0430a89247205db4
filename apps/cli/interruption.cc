#include "apps/cli/interruption.h"

#include "apps/cli/command.h"
#include "apps/cli/json_answer.h"
#include "apps/output/folder_lock.h"
#include "fem/values/mesh_phase.h"
#include "fem/values/passing_folder.h"

#include <sys/wait.h>

#include <csignal>
#include <cstring>
#include <ctime>
#include <unistd.h>

namespace gestell::apps
{

namespace
{
std::atomic<bool> interrupted{false};
std::atomic<bool> nothing_to_save{false}; ///< and nothing to clean up: the end may come at once
std::atomic<bool> meshing{false};         ///< the child process of gmsh ends first
timespec          first_time{};

double seconds_since_first()
{
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<double>(now.tv_sec - first_time.tv_sec) +
         1e-9 * static_cast<double>(now.tv_nsec - first_time.tv_nsec);
}

std::atomic<const char *> leaving{nullptr}; ///< for a shell: remove the lock, empty folders and temporary files

/// Nobody unwinds the stack of a computation that hears nothing.
void leave_nothing()
{
  const char *const words = leaving;
  const pid_t       shell = words == nullptr ? -1 : _Fork();
  if (shell == 0)
  {
    close(STDERR_FILENO);
    execl("/bin/sh", "sh", "-c", words, static_cast<char *>(nullptr));
    _exit(127);
  }
  if (shell > 0)
    waitpid(shell, nullptr, 0);
}

// Only what is safe in a signal handler: an atomic, clock_gettime, write, _Fork, execl, waitpid, _exit, signal, raise.
extern "C" void note_interruption(int signal_number)
{
  if (nothing_to_save)
  {
    constexpr char              message[] = "\ngestell: interrupted; nothing was computed yet that could be saved\n";
    [[maybe_unused]] const auto written   = write(STDERR_FILENO, message, sizeof message - 1);
    leave_nothing();
    _exit(exit_interrupted);
  }
  if (!interrupted.exchange(true))
  {
    clock_gettime(CLOCK_MONOTONIC, &first_time);
    constexpr char saving[] = "\ngestell: interrupted; saving what was computed (once more: end at once)\n";
    constexpr char ending[] = "\ngestell: interrupted; ending (once more: end at once)\n";
    if ((meshing ? write(STDERR_FILENO, ending, sizeof ending - 1) : write(STDERR_FILENO, saving, sizeof saving - 1)) <
        0)
      return;
  }
  // Whoever signals a process and its group sends two at once: that is one wish.
  else if (seconds_since_first() > 0.5)
  {
    std::signal(signal_number, SIG_DFL);
    raise(signal_number);
  }
}
} // namespace

const std::atomic<bool> &interruption()
{
  static const bool installed = []
  {
    std::signal(SIGINT, note_interruption);
    std::signal(SIGTERM, note_interruption);
    std::signal(SIGHUP, note_interruption);
    return true;
  }();
  (void)installed;
  return interrupted;
}

void note_what_is_left()
{
  leaving = strdup((words_of_release() + fem::words_of_removal()).c_str()); // never freed: a signal may be reading
}

coupling::Progress nothing_to_save_before(const std::string &phase, const coupling::Progress &progress)
{
  const bool plain = !answers_in_json(); // of which there is a document in any case
  note_what_is_left();
  nothing_to_save = plain;
  return [phase, progress, plain, before = true](const std::string &now, double share) mutable
  {
    before          = before && now != phase;
    meshing         = fem::may_be_stopped(now); // by an exception, which removes its files
    nothing_to_save = plain && before && !meshing;
    if (progress)
      progress(now, share);
  };
}

} // namespace gestell::apps
