#include "apps/study/runs/run_pool.h"

#include "coupling/frame/atomic_file.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <new>
#include <poll.h>
#include <stdexcept>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace gestell::apps
{
namespace
{

constexpr int most_jobs = 1024; ///< at once: more than the cores of any machine, less than its processes

/// What the processes share.
struct Shared
{
  std::atomic<std::size_t> next{0};
  std::atomic<bool>        stop{false};
  std::atomic<long>        current[most_jobs]; ///< order that each is at; -1: none
};
static_assert(std::atomic<std::size_t>::is_always_lock_free && std::atomic<long>::is_always_lock_free);

/// Memory that processes made later share.
class SharedMemory
{
public:
  SharedMemory()
  {
    void *memory = mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED)
      throw std::runtime_error(std::string("study: no shared memory for --jobs: ") + std::strerror(errno));
    shared_ = new (memory) Shared;
  }
  ~SharedMemory() { munmap(shared_, sizeof(Shared)); }
  SharedMemory(const SharedMemory &) = delete;

  Shared &operator*() const { return *shared_; }
  Shared *operator->() const { return shared_; }

private:
  Shared *shared_;
};

void write_all(int pipe, const std::string &text)
{
  for (std::size_t done = 0; done < text.size();)
  {
    const ssize_t n = write(pipe, text.data() + done, text.size() - done);
    if (n < 0 && errno != EINTR)
      _exit(1);
    done += std::size_t(std::max<ssize_t>(n, 0));
  }
}

// What a worker tells: "R row" and "U unit<tab>unit" of a run that ended, "E message" of a study that cannot go on,
// "W message" of a file that could not be written.

std::string on_one_line(std::string message)
{
  std::replace(message.begin(), message.end(), '\n', '\x01');
  return message;
}

std::string reported(const RunRow &row, const std::string &line)
{
  std::string units;
  for (const std::string &unit : row.units)
    units += unit + '\t';
  return 'U' + units + "\nR" + line;
}

/// What no run of the study has is an error of the study, not of a run.
void refuse_lacking(const RunRow &row, std::size_t order, FirstRun first)
{
  if (row.lacks_output && order == 0 && first == FirstRun::decides)
    throw std::invalid_argument(row.message);
}

void work(int pipe, int worker, StudyRunner &runner, const RowsText &text, const std::vector<RunOrder> &orders,
          FirstRun first, Shared &shared)
{
  while (!shared.stop)
  {
    const std::size_t at = shared.next++;
    if (at >= orders.size())
      break;
    shared.current[worker] = long(at);
    const RunRow row       = runner.run(orders[at].number, orders[at].levels, &shared.stop);
    refuse_lacking(row, at, first);
    if (row.status != RunStatus::waiting)
      write_all(pipe, reported(row, text.line(row, orders[at].levels)));
    shared.current[worker] = -1;
  }
}

struct Worker
{
  pid_t                    process = -1;
  int                      pipe    = -1; ///< -1: it has ended
  std::string              heard{};      ///< and not yet understood
  std::vector<std::string> units{};
};

class Pool
{
public:
  Pool(StudyRunner &runner, const RowsText &text, const std::vector<RunOrder> &orders, FirstRun first,
       const std::atomic<bool> &stop, const TakeRow &take)
      : runner_(runner), text_(text), orders_(orders), first_(first), stop_(stop), take_(take)
  {
  }
  ~Pool()
  {
    shared_->stop = true;
    for (Worker &worker : workers_)
      if (worker.pipe >= 0)
      {
        close(worker.pipe);
        waitpid(worker.process, nullptr, 0);
      }
  }
  Pool(const Pool &) = delete;

  void make(int jobs)
  {
    workers_.resize(std::size_t(jobs));
    for (int i = 0; i < jobs; ++i)
      begin(i);
    while (listen())
      if (stop_)
        shared_->stop = true;
    if (!disk_.empty())
      throw coupling::WriteFailure(disk_);
    if (!failure_.empty())
      throw std::invalid_argument(failure_);
  }

private:
  void begin(int number)
  {
    int ends[2];
    if (pipe(ends) != 0)
      throw std::runtime_error(std::string("study: --jobs: ") + std::strerror(errno));
    shared_->current[number] = -1;
    const pid_t process      = fork();
    if (process < 0)
      throw std::runtime_error(std::string("study: --jobs: ") + std::strerror(errno));
    if (process == 0)
    {
      close(ends[0]);
      be_worker(ends[1], number);
    }
    close(ends[1]);
    workers_[std::size_t(number)] = {process, ends[0]};
  }

  [[noreturn]] void be_worker(int pipe, int number)
  {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE}) // the parent says when to stop
      std::signal(signal, SIG_IGN);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    try
    {
      work(pipe, number, runner_, text_, orders_, first_, *shared_);
    }
    catch (const coupling::WriteFailure &failure)
    {
      write_all(pipe, 'W' + on_one_line(failure.what()) + '\n');
    }
    catch (const std::exception &error)
    {
      write_all(pipe, 'E' + on_one_line(error.what()) + '\n');
    }
    _exit(0);
  }

  /// Waits a moment for words of the workers; false once all have ended.
  bool listen()
  {
    std::vector<pollfd>      polled;
    std::vector<std::size_t> numbers;
    for (std::size_t i = 0; i < workers_.size(); ++i)
      if (workers_[i].pipe >= 0)
      {
        polled.push_back({workers_[i].pipe, POLLIN, 0});
        numbers.push_back(i);
      }
    if (polled.empty())
      return false;
    if (poll(polled.data(), polled.size(), 100) > 0)
      for (std::size_t i = 0; i < polled.size(); ++i)
        if (polled[i].revents)
          hear(int(numbers[i]));
    return true;
  }

  void hear(int number)
  {
    Worker       &worker = workers_[std::size_t(number)];
    char          buffer[65536];
    const ssize_t n = read(worker.pipe, buffer, sizeof buffer);
    if (n < 0 && errno == EINTR)
      return;
    if (n <= 0)
      return end(number);
    worker.heard.append(buffer, std::size_t(n));
    for (std::size_t line = worker.heard.find('\n'); line != std::string::npos; line = worker.heard.find('\n'))
    {
      understand(worker, worker.heard.substr(0, line));
      worker.heard.erase(0, line + 1);
    }
  }

  void understand(Worker &worker, const std::string &line)
  {
    const std::string rest = line.substr(1);
    if (line.front() == 'E' || line.front() == 'W')
    {
      std::string &failure = line.front() == 'E' ? failure_ : disk_;
      failure              = rest;
      std::replace(failure.begin(), failure.end(), '\x01', '\n');
      shared_->stop = true;
    }
    else if (line.front() == 'U')
    {
      worker.units.clear();
      for (std::size_t at = 0, tab; (tab = rest.find('\t', at)) != std::string::npos; at = tab + 1)
        worker.units.push_back(rest.substr(at, tab - at));
    }
    else
    {
      RunRow row = text_.row(rest);
      row.units  = worker.units;
      take_(row);
    }
  }

  /// A worker has ended: all is done, or it died at a run.
  void end(int number)
  {
    Worker &worker = workers_[std::size_t(number)];
    close(worker.pipe);
    worker.pipe = -1;
    int status  = 0;
    waitpid(worker.process, &status, 0);
    // Whoever kills a process for its memory leaves this one alone; whoever kills all takes no longer.
    constexpr std::chrono::milliseconds all_are_killed{50};
    if (WIFSIGNALED(status) && !stop_)
      std::this_thread::sleep_for(all_are_killed);
    const long at = shared_->current[number];
    if (at < 0 || (WIFEXITED(status) && WEXITSTATUS(status) == 0) || shared_->stop || stop_)
      return;
    RunRow row;
    row.run     = orders_[std::size_t(at)].number;
    row.status  = RunStatus::failed;
    row.message = WIFSIGNALED(status) ? std::string("its process ended by a signal: ") + strsignal(WTERMSIG(status)) +
                                            (WTERMSIG(status) == SIGKILL ? "; did they run out of memory?" : "")
                                      : "its process ended with code " + std::to_string(WEXITSTATUS(status));
    take_(row);
    begin(number);
  }

  StudyRunner                 &runner_;
  const RowsText              &text_;
  const std::vector<RunOrder> &orders_;
  FirstRun                     first_;
  const std::atomic<bool>     &stop_;
  const TakeRow               &take_;
  SharedMemory                 shared_;
  std::vector<Worker>          workers_;
  std::string                  failure_, disk_; ///< of the study, and of writing what is kept of a run
};

} // namespace

void make_runs(StudyRunner &runner, const RowsText &text, const std::vector<RunOrder> &orders, int jobs, FirstRun first,
               const std::atomic<bool> &stop, const TakeRow &take)
{
  if (jobs > most_jobs)
    throw std::invalid_argument("--jobs " + std::to_string(jobs) + ": " + std::to_string(most_jobs) + " are the most");
  if (jobs > 1)
    return Pool(runner, text, orders, first, stop, take).make(std::min<int>(jobs, int(orders.size())));
  for (const RunOrder &order : orders)
  {
    if (stop)
      return;
    const RunRow row = runner.run(order.number, order.levels, &stop);
    refuse_lacking(row, std::size_t(&order - orders.data()), first);
    if (row.status != RunStatus::waiting)
      take(row);
  }
}

} // namespace gestell::apps
