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
std::atomic<bool> nothing_to_save{false}; ///< the end may come at once
std::atomic<bool> saves_nothing{false};   ///< the command saves nothing when it is interrupted
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

/// Removes what destructors would remove, which do not run where a signal ends the process.
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
    constexpr char              nothing[] = "\ngestell: interrupted; nothing was computed yet that could be saved\n";
    constexpr char              ended[]   = "\ngestell: interrupted; files that are not there yet are not written\n";
    [[maybe_unused]] const auto written   = saves_nothing ? write(STDERR_FILENO, ended, sizeof ended - 1)
                                                          : write(STDERR_FILENO, nothing, sizeof nothing - 1);
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

/// Whether this is what the process does on the signal.
bool is_handled(int signal_number, void (*by)(int))
{
  struct sigaction now = {};
  return sigaction(signal_number, nullptr, &now) == 0 && !(now.sa_flags & SA_SIGINFO) && now.sa_handler == by;
}
} // namespace

void end_where_nothing_is_saved()
{
  note_what_is_left();
  for (const int number : {SIGINT, SIGTERM, SIGHUP})
    if (is_handled(number, SIG_DFL))
    {
      saves_nothing = nothing_to_save = true;
      std::signal(number, note_interruption);
    }
}

const std::atomic<bool> &interruption()
{
  static const bool installed = []
  {
    if (saves_nothing.exchange(false))
      nothing_to_save = false;
    std::signal(SIGINT, note_interruption);
    std::signal(SIGTERM, note_interruption);
    if (!is_handled(SIGHUP, SIG_IGN)) // as nohup asks
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
