#include "fem/process/child.h"

#include "fem/process/child_messages.h"
#include "fem/process/ended_by_signal.h"
#include "fem/values/message_text.h"
#include "fem/values/temporary_directory.h"

#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <mutex>
#include <new>
#include <optional>
#include <stdexcept>

namespace gestell::fem
{

namespace
{

struct Pipe
{
  int read_end = -1, write_end = -1;

  Pipe()
  {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0)
      throw std::runtime_error(std::string("cannot create a pipe to a child process: ") + std::strerror(errno));
    read_end  = ends[0];
    write_end = ends[1];
  }
  ~Pipe()
  {
    close_end(read_end);
    close_end(write_end);
  }
  Pipe(const Pipe &)            = delete;
  Pipe &operator=(const Pipe &) = delete;

  static void close_end(int &end)
  {
    if (end >= 0)
      ::close(end);
    end = -1;
  }
};

/// Memory [byte] of data that this process has: VmData and stack.
double data_of_process()
{
  std::ifstream in("/proc/self/statm");
  double        size, resident, shared, text, library, data = 0.;
  in >> size >> resident >> shared >> text >> library >> data;
  return data * static_cast<double>(::sysconf(_SC_PAGESIZE));
}

/// Sets the soft limit, which is never raised above the one that is there.
void limit(__rlimit_resource_t resource, double value)
{
  rlimit now = {};
  if (::getrlimit(resource, &now) != 0)
    return;
  const double soft = now.rlim_cur == RLIM_INFINITY ? HUGE_VAL : static_cast<double>(now.rlim_cur);
  if (value < std::min(soft, 1e18))
    now.rlim_cur = static_cast<rlim_t>(std::ceil(value));
  ::setrlimit(resource, &now);
}

/// The child's side: its messages and its limits.
class Child
{
public:
  Child(const ChildTask &task, MessageWriter &out, const TemporaryDirectory &folder) : task_(task), out_(out)
  {
    for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE}) // the parent decides when to stop
      std::signal(number, SIG_IGN);
    for (const int number : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGXCPU})
      std::signal(number, SIG_DFL);
    ::setenv("TMPDIR", folder.path().c_str(), 1);
    begin_limits();
  }

  /// @return the exit code
  int run(const std::function<std::string(const ChildProgress &)> &work)
  {
    try
    {
      out_.send(ChildMessage::result, work([this](const std::string &phase, double share) { tell(phase, share); }));
    }
    catch (const std::invalid_argument &error)
    {
      out_.send(ChildMessage::invalid_argument, error.what());
    }
    catch (const std::bad_alloc &)
    {
      out_.send(ChildMessage::bad_alloc, "");
    }
    catch (const std::exception &error)
    {
      out_.send(ChildMessage::runtime_error, error.what());
    }
    catch (...)
    {
      out_.send(ChildMessage::runtime_error, task_.head + ": an exception without message");
    }
    return 0;
  }

private:
  void begin_limits()
  {
    ::getrlimit(RLIMIT_CPU, &seconds_before_);
    ::getrlimit(RLIMIT_DATA, &bytes_before_);
    const rlimit no_core = {0, 0};
    ::setrlimit(RLIMIT_CORE, &no_core);
    if (task_.limits.seconds > 0.)
      limit(RLIMIT_CPU, task_.limits.seconds);
    if (task_.limits.bytes > 0.)
      limit(RLIMIT_DATA, data_of_process() + task_.limits.bytes);
    reads_ = true;
  }

  void end_limits()
  {
    ::setrlimit(RLIMIT_CPU, &seconds_before_);
    ::setrlimit(RLIMIT_DATA, &bytes_before_);
    reads_ = false;
  }

  void tell(const std::string &phase, double share)
  {
    if (reads_ && phase != task_.phase)
      end_limits();
    out_.send_progress(phase, share);
  }

  const ChildTask &task_;
  MessageWriter   &out_;
  bool             reads_ = false;
  rlimit           seconds_before_{}, bytes_before_{};
};

/// The parent's side.
class Parent
{
public:
  Parent(const ChildTask &task, const ChildProgress &progress, pid_t child, int messages, int words)
      : task_(task), progress_(progress), child_(child), messages_(messages), words_(words), phase_(task.phase)
  {
  }
  ~Parent()
  {
    if (child_ > 0)
    {
      ::kill(child_, SIGKILL);
      wait();
    }
  }
  Parent(const Parent &)            = delete;
  Parent &operator=(const Parent &) = delete;

  /// @return whether the child has ended by itself, not by a signal to this process.
  bool listen(const EndedBySignal &ended)
  {
    pollfd polled[] = {{messages_, POLLIN, 0}, {words_, POLLIN, 0}};
    while (polled[0].fd >= 0 && !answer_) // a child of another thread may have the other end open
    {
      constexpr std::chrono::milliseconds told_again{100}; // a tenth of a second: what a person sees as steady
      const int                           n = ::poll(polled, 2, int(told_again.count()));
      if (ended.requested())
        return false;
      if (const auto now = std::chrono::steady_clock::now(); progress_ && now - reported_ >= told_again)
      {
        reported_ = now;
        progress_(phase_, share_);
      }
      if (n > 0 && polled[1].revents && !hear_words())
        polled[1].fd = -1;
      if (n > 0 && polled[0].revents && !hear_messages())
        polled[0].fd = -1;
    }
    while (polled[1].fd >= 0 && ::poll(polled + 1, 1, 0) > 0 && hear_words())
    {
    }
    return true;
  }

  std::string result()
  {
    const int status = wait();
    if (answer_ && WIFEXITED(status))
      return answer(*answer_);
    if (ran_out_of_memory_)
      throw std::invalid_argument(task_.head + ": " + out_of_memory());
    if (reads() && WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)
      throw std::invalid_argument(task_.head + ": " + never_ends());
    if (!reads() && WIFSIGNALED(status) && WTERMSIG(status) != SIGKILL &&
        WTERMSIG(status) != SIGXCPU) // killed: by a user, for its memory, or by a limit of time
      throw ChildFault(task_.head + ": " + how_it_died(status));
    throw std::invalid_argument(task_.head + ": " + how_it_died(status));
  }

private:
  bool reads() const { return phase_ == task_.phase; }

  int wait()
  {
    int status = 0;
    while (::waitpid(child_, &status, 0) < 0 && errno == EINTR)
    {
    }
    child_ = -1;
    return status;
  }

  bool hear_words()
  {
    char          buffer[1024];
    const ssize_t n = ::read(words_, buffer, sizeof buffer);
    if (n > 0)
      said_.append(buffer, static_cast<std::size_t>(n));
    constexpr size_t words_kept = 4096; // of the child's standard error: its last page
    if (said_.size() > words_kept)
      said_.erase(0, said_.size() - words_kept);
    return n > 0 || (n < 0 && errno == EINTR);
  }

  bool hear_messages()
  {
    const bool goes_on = reader_.read_some(messages_);
    while (auto message = reader_.next())
      switch (message->kind)
      {
      case ChildMessage::progress:
        if (const std::string before = phase_; std::tie(share_, phase_) = progress_in(message->text), phase_ != before)
          ran_out_of_memory_ = false; // survived
        if (progress_)
          progress_(phase_, share_);
        break;
      case ChildMessage::out_of_memory:
        ran_out_of_memory_ = true;
        break;
      default:
        answer_ = std::move(*message);
      }
    return goes_on;
  }

  std::string answer(TextMessage &message) const
  {
    switch (message.kind)
    {
    case ChildMessage::result:
      return std::move(message.text);
    case ChildMessage::bad_alloc:
      throw std::invalid_argument(task_.head + ": " + out_of_memory());
    case ChildMessage::invalid_argument:
      throw std::invalid_argument(ran_out_of_memory_ ? task_.head + ": " + out_of_memory() : message.text);
    default:
      if (ran_out_of_memory_)
        throw std::invalid_argument(task_.head + ": " + out_of_memory());
      throw std::runtime_error(message.text);
    }
  }

  std::string way_out() const
  {
    return reads() || task_.path.empty() ? task_.way_out
                                         : "choose another mesh.size, or repair the geometry in the CAD program";
  }

  std::string out_of_memory() const
  {
    if (!reads())
      return "out of memory (" + phase_ + "); choose a larger mesh.size, or a computer with more memory.";
    return "out of memory while reading it" +
           (task_.limits.bytes > 0.
                ? ": more than " + text(std::round(task_.limits.bytes / 1e8) / 10.) + " GB for " + size_text(task_.path)
                : "") +
           "; " + way_out() +
           ", or use a computer with more memory; the environment variable GESTELL_ONE_PROCESS=1 removes the limit.";
  }

  std::string never_ends() const
  {
    return "reading took more than " + text(task_.limits.seconds) + " s of processor time, the limit for " +
           size_text(task_.path) + ", and did not finish; " + way_out() +
           ". If the file is sound and slow, GESTELL_READING_SECONDS=" + text(10. * task_.limits.seconds) +
           " in the environment sets another limit, 0 removes it.";
  }

  std::string how_it_died(int status) const
  {
    const bool        killed = WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL;
    const std::string how =
        killed ? "was killed: out of memory, or ended by a system limit or a user"
        : WIFSIGNALED(status)
            ? "was ended by signal " + std::to_string(WTERMSIG(status)) + " (" + ::strsignal(WTERMSIG(status)) + ")"
            : "ended the process (exit code " + std::to_string(WEXITSTATUS(status)) + ")";
    return task_.library + " " + how + " (" + phase_ + ")" + last_words() + "; " + way_out() + ".";
  }

  /// The last line that the child wrote to its standard error.
  std::string last_words() const
  {
    constexpr std::size_t longest = 200; // letters of a message
    std::string           words   = said_.substr(0, said_.find_last_not_of(" \n") + 1);
    words.erase(0, words.rfind('\n') + 1);
    return words.empty() ? "" : ", with the message \"" + words.substr(0, longest) + "\"";
  }

  const ChildTask                      &task_;
  const ChildProgress                  &progress_;
  pid_t                                 child_;
  int                                   messages_, words_;
  std::string                           phase_, said_;
  double                                share_             = -1.;
  std::chrono::steady_clock::time_point reported_          = std::chrono::steady_clock::now();
  bool                                  ran_out_of_memory_ = false;
  MessageReader                         reader_;
  std::optional<TextMessage>            answer_;
};

/// For malloc's failures in the child: a message, before the exception which a library may hide.
int out_of_memory_told_to = -1;

void tell_out_of_memory()
{
  const MessageHead head = {ChildMessage::out_of_memory, 0};
  if (::write(out_of_memory_told_to, &head, sizeof head) < 0)
    ::_exit(1);
  std::set_new_handler(nullptr);
  throw std::bad_alloc();
}

[[noreturn]] void be_child(const ChildTask &task, const TemporaryDirectory &folder, pid_t parent, int messages,
                           int words, const std::function<std::string(const ChildProgress &)> &work)
{
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent)
    ::_exit(1);
  const int nowhere = ::open("/dev/null", O_RDWR | O_CLOEXEC); // a question of a script would wait for ever
  ::dup2(nowhere, STDIN_FILENO);
  ::dup2(nowhere, STDOUT_FILENO);
  ::dup2(words, STDERR_FILENO);
  out_of_memory_told_to = messages;
  std::set_new_handler(tell_out_of_memory);
  int code = 1;
  try
  {
    MessageWriter out(messages);
    code = Child(task, out, folder).run(work);
  }
  catch (...) // no memory to report it
  {
  }
  ::_exit(code);
}

} // namespace

bool in_one_process()
{
  const char *value = std::getenv("GESTELL_ONE_PROCESS");
  return value && *value && std::strcmp(value, "0") != 0;
}

std::string bytes_from_child(const ChildTask &task, const ChildProgress &progress,
                             const std::function<std::string(const ChildProgress &)> &work)
{
  const EndedBySignal      ended; // obeyed when all below is gone
  const TemporaryDirectory folder;
  Pipe                     messages, words;
  const pid_t              parent = ::getpid(), child = ::fork();
  if (child < 0)
    throw std::runtime_error(task.head + ": cannot create a child process to read it: " + std::strerror(errno) +
                             "; GESTELL_ONE_PROCESS=1 in the environment reads it in this process.");
  if (child == 0)
    be_child(task, folder, parent, messages.write_end, words.write_end, work);
  Pipe::close_end(messages.write_end);
  Pipe::close_end(words.write_end);
  Parent here(task, progress, child, messages.read_end, words.read_end);
  if (!here.listen(ended))
    throw std::runtime_error(task.head + ": interrupted"); // the signal comes first
  return here.result();
}

} // namespace gestell::fem
