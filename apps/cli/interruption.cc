#include "apps/cli/interruption.h"

#include "apps/cli/command.h"
#include "apps/cli/json_answer.h"
#include "apps/output/folder_lock.h"
#include "fem/values/mesh_phase.h"
#include "fem/values/temporary_directory.h"

#include <sys/wait.h>

#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <ctime>
#include <unistd.h>

namespace gestell::apps
{

namespace
{
/// Present effect of an interruption.
enum class Interruption
{
  saves,             ///< what was computed
  ends,              ///< as soon as the child process of gmsh has ended
  ends_at_once,      ///< nothing was computed yet
  ends_without_files ///< at once: the command saves nothing
};

std::atomic<bool>         interrupted{false};
std::atomic<Interruption> effect{Interruption::saves};
std::atomic<std::int64_t> first_signal{0}; ///< [ns]
static_assert(std::atomic<Interruption>::is_always_lock_free && std::atomic<std::int64_t>::is_always_lock_free,
              "else no handler of signals may ask them");

void say(const char *words)
{
  [[maybe_unused]] const auto written = write(STDERR_FILENO, words, std::strlen(words));
}

std::int64_t nanoseconds()
{
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t{1000000000} * now.tv_sec + now.tv_nsec;
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

// Only what is safe in a signal handler: atomics, strlen, clock_gettime, write, _Fork, execl, waitpid, _exit, signal,
// raise.
extern "C" void note_interruption(int signal_number)
{
  const int          error = errno;
  const Interruption now   = effect;
  if (now == Interruption::ends_at_once || now == Interruption::ends_without_files)
  {
    say(now == Interruption::ends_at_once ? "\ngestell: interrupted; there are no results to save yet\n"
                                          : "\ngestell: interrupted; the remaining files are not written\n");
    leave_nothing();
    _exit(exit_interrupted);
  }
  const std::int64_t time  = nanoseconds();
  std::int64_t       first = 0;
  // [ns] a key that repeats, or a signal to the group and to the process, is one wish
  constexpr std::int64_t one_wish = 500000000;
  if (first_signal.compare_exchange_strong(first, time))
  {
    interrupted = true;
    say(now == Interruption::ends ? "\ngestell: interrupted; ending (interrupt again to end immediately)\n"
                                  : "\ngestell: interrupted; saving results (interrupt again to end immediately)\n");
  }
  // Whoever signals a process and its group sends two at once: that is one wish.
  else if (time - first > one_wish)
  {
    std::signal(signal_number, SIG_DFL);
    raise(signal_number);
  }
  errno = error;
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
      effect = Interruption::ends_without_files;
      std::signal(number, note_interruption);
    }
}

const std::atomic<bool> &interruption()
{
  static const bool installed = []
  {
    Interruption before = Interruption::ends_without_files;
    effect.compare_exchange_strong(before, Interruption::saves);
    std::signal(SIGINT, note_interruption);
    std::signal(SIGTERM, note_interruption);
    if (!is_handled(SIGHUP, SIG_IGN)) // as set by nohup
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
  const bool plain = !answers_in_json(); // the document is written in any case
  note_what_is_left();
  effect = plain ? Interruption::ends_at_once : Interruption::saves;
  return [phase, progress, plain, before = true](const std::string &now, double share) mutable
  {
    before = before && now != phase;
    effect = fem::may_be_stopped(now) ? Interruption::ends // by an exception, which removes its files
             : plain && before        ? Interruption::ends_at_once
                                      : Interruption::saves;
    if (progress)
      progress(now, share);
  };
}

} // namespace gestell::apps
