#include "apps/study/runs/run_server.h"

#include <cerrno>
#include <csignal>
#include <cstring>
#include <new>
#include <poll.h>
#include <stdexcept>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace gestell::apps
{
namespace
{

/// What is asked of a worker, followed by the levels.
struct RunQuestion
{
  int          number          = 0;
  bool         has_derivatives = false;
  Eigen::Index n_levels        = 0;
};

/// What it answers, followed by the row as a line and the derivatives.
struct RunReply
{
  RunStatus    status    = RunStatus::waiting;
  Eigen::Index n_letters = 0, n_outputs = 0, n_variables = 0;
};

bool write_whole(int pipe, const void *bytes, std::size_t size)
{
  for (std::size_t done = 0; done < size;)
  {
    const ssize_t n = write(pipe, static_cast<const char *>(bytes) + done, size - done);
    if (n < 0 && errno != EINTR)
      return false;
    done += std::size_t(std::max<ssize_t>(n, 0));
  }
  return true;
}

std::size_t bytes_of(Eigen::Index n_numbers)
{
  return std::size_t(n_numbers) * sizeof(double);
}

bool ask(int pipe, const RunQuestion &question, const Eigen::VectorXd &levels)
{
  return write_whole(pipe, &question, sizeof question) && write_whole(pipe, levels.data(), bytes_of(levels.size()));
}

bool reply(int pipe, RunStatus status, const std::string &line, const Eigen::MatrixXd &derivatives)
{
  const RunReply head{status, Eigen::Index(line.size()), derivatives.rows(), derivatives.cols()};
  return write_whole(pipe, &head, sizeof head) && write_whole(pipe, line.data(), line.size()) &&
         write_whole(pipe, derivatives.data(), bytes_of(derivatives.size()));
}

/// Its parent waits for nothing else: no poll.
bool read_question(int pipe, void *bytes, std::size_t size)
{
  for (std::size_t done = 0; done < size;)
  {
    const ssize_t n = read(pipe, static_cast<char *>(bytes) + done, size - done);
    if (n == 0 || (n < 0 && errno != EINTR))
      return false;
    done += std::size_t(std::max<ssize_t>(n, 0));
  }
  return true;
}

void serve(int questions, int replies, StudyRunner &runner, const RowsText &text, const std::atomic<bool> &stop)
{
  RunQuestion question;
  while (read_question(questions, &question, sizeof question))
  {
    Eigen::VectorXd levels(question.n_levels);
    Eigen::MatrixXd derivatives;
    if (!read_question(questions, levels.data(), bytes_of(levels.size())))
      return;
    const RunRow row = runner.run(question.number, levels, &stop, question.has_derivatives ? &derivatives : nullptr);
    if (!reply(replies, row.status, text.line(row, levels), derivatives))
      return;
  }
}

RunRow failed_row(int number, const std::string &message)
{
  RunRow row;
  row.run     = number;
  row.status  = RunStatus::failed;
  row.message = message;
  return row;
}

} // namespace

struct RunServer::Worker
{
  pid_t process   = -1;
  int   questions = -1, replies = -1;
};

RunServer::RunServer(StudyRunner &runner, const RowsText &text, int jobs, const std::atomic<bool> &stop)
    : runner_(runner), text_(text), stop_(stop)
{
  if (jobs < 2)
    return;
  std::signal(SIGPIPE, SIG_IGN); // a worker that died is noticed where it is asked
  void *memory = mmap(nullptr, sizeof *stop_of_workers_, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED)
    throw std::runtime_error(std::string("study: no shared memory for --jobs: ") + std::strerror(errno));
  stop_of_workers_ = new (memory) std::atomic<bool>(false);
  for (int i = 0; i < jobs; ++i)
    begin_worker();
}

RunServer::~RunServer()
{
  if (stop_of_workers_)
    *stop_of_workers_ = true;
  for (const auto &worker : workers_)
    if (worker->process >= 0)
    {
      close(worker->questions);
      close(worker->replies);
      waitpid(worker->process, nullptr, 0);
    }
  if (stop_of_workers_)
    munmap(stop_of_workers_, sizeof *stop_of_workers_);
}

void RunServer::begin_worker()
{
  int questions[2], replies[2];
  if (pipe(questions) != 0 || pipe(replies) != 0)
    throw std::runtime_error(std::string("study: --jobs: ") + std::strerror(errno));
  const pid_t process = fork();
  if (process < 0)
    throw std::runtime_error(std::string("study: --jobs: ") + std::strerror(errno));
  if (process == 0)
  {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE}) // the parent says when to stop
      std::signal(signal, SIG_IGN);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    for (const auto &other : workers_) // so that their ends are seen
    {
      close(other->questions);
      close(other->replies);
    }
    close(questions[1]);
    close(replies[0]);
    try
    {
      serve(questions[0], replies[1], runner_, text_, *stop_of_workers_);
    }
    catch (const std::exception &) // the stack below is the parent's
    {
      _exit(1);
    }
    _exit(0);
  }
  close(questions[0]);
  close(replies[1]);
  workers_.push_back(std::make_unique<Worker>(Worker{process, questions[1], replies[0]}));
  free_.push_back(workers_.back().get());
  ++n_living_;
}

RunServer::Worker *RunServer::free_worker()
{
  std::unique_lock<std::mutex> alone(mutex_);
  given_back_.wait(alone, [&] { return !free_.empty() || n_living_ == 0; });
  if (n_living_ == 0)
    throw std::runtime_error("study: all processes of --jobs have died, probably out of memory; use fewer --jobs");
  Worker *worker = free_.back();
  free_.pop_back();
  return worker;
}

void RunServer::give_back(Worker *worker, bool lives)
{
  const std::lock_guard<std::mutex> alone(mutex_);
  if (lives)
    free_.push_back(worker);
  else
    --n_living_;
  given_back_.notify_all();
}

/// False where the worker has died.
bool RunServer::read_whole(int pipe, void *bytes, std::size_t size)
{
  for (std::size_t done = 0; done < size;)
  {
    pollfd polled{pipe, POLLIN, 0};
    if (stop_)
      *stop_of_workers_ = true;
    if (poll(&polled, 1, 100) <= 0)
      continue;
    const ssize_t n = read(pipe, static_cast<char *>(bytes) + done, size - done);
    if (n == 0 || (n < 0 && errno != EINTR))
      return false;
    done += std::size_t(std::max<ssize_t>(n, 0));
  }
  return true;
}

RunRow RunServer::requested(Worker &worker, int number, const Eigen::VectorXd &levels, Eigen::MatrixXd *derivatives,
                            bool &lives)
{
  RunReply    head;
  std::string line;
  lives = ask(worker.questions, {number, derivatives != nullptr, levels.size()}, levels) &&
          read_whole(worker.replies, &head, sizeof head);
  if (!lives)
    return failed_row(number, "its process has died");
  line.resize(std::size_t(head.n_letters));
  Eigen::MatrixXd read(head.n_outputs, head.n_variables);
  lives = read_whole(worker.replies, line.data(), line.size()) &&
          read_whole(worker.replies, read.data(), bytes_of(read.size()));
  if (!lives)
    return failed_row(number, "its process has died");
  if (derivatives)
    *derivatives = read;
  line.pop_back(); // the end of the line
  RunRow row = text_.row(line);
  row.status = head.status;
  return row;
}

RunRow RunServer::run(int number, const Eigen::VectorXd &levels, Eigen::MatrixXd *derivatives)
{
  if (workers_.empty())
    return runner_.run(number, levels, &stop_, derivatives);
  Worker      *worker = free_worker();
  bool         lives  = true;
  const RunRow row    = requested(*worker, number, levels, derivatives, lives);
  give_back(worker, lives);
  return row;
}

} // namespace gestell::apps
