#include "tests/fuzz/mesh/mesh_fuzz.h"

#include "fem/process/child_messages.h"
#include "fem/values/temporary_directory.h"
#include "tests/fuzz/mesh/mesh_mutation.h"
#include "tests/fuzz/watched_process.h"

#include <sys/wait.h>

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <optional>
#include <sstream>
#include <stdexcept>

namespace gestell::fuzz
{
namespace
{

namespace files = std::filesystem;
using fem::ChildMessage;
using fem::MessageReader;
using fem::MessageWriter;

constexpr std::uint64_t of_one_process = 500;
constexpr double        longest_alone  = 10.; // [s]

/// A forked process that judges files and tells of each.
class Judge
{
public:
  /// @param work  tells by tell()
  explicit Judge(const std::function<void(MessageWriter &)> &work)
  {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0)
      throw std::runtime_error("no pipe");
    pipe_    = ends[0];
    process_ = ::fork();
    if (process_ < 0)
      throw std::runtime_error("no process");
    if (process_ == 0)
    {
      be_quiet_child();
      MessageWriter out(ends[1]);
      work(out);
      ::_exit(0);
    }
    ::close(ends[1]);
  }
  ~Judge()
  {
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
    ::close(pipe_);
  }
  Judge(const Judge &)            = delete;
  Judge &operator=(const Judge &) = delete;

  /// The next judgement; none if the process has ended, or took more processor time, or very long.
  std::optional<Judgement> next(double seconds)
  {
    constexpr double of_busy_machines = 60.;
    const double     begin            = processor_seconds(process_);
    const auto       wait_until =
        std::chrono::steady_clock::now() + std::chrono::duration<double>(of_busy_machines * seconds);
    while (true)
    {
      if (auto message = reader_.next())
        return Judgement{static_cast<Outcome>(message->text[0]), message->text.substr(1)};
      pollfd    polled = {pipe_, POLLIN, 0};
      const int n      = ::poll(&polled, 1, 200);
      if (n > 0 ? !reader_.read_some(pipe_)
                : processor_seconds(process_) > begin + seconds || std::chrono::steady_clock::now() > wait_until)
        return std::nullopt;
    }
  }

private:
  int           pipe_    = -1;
  pid_t         process_ = -1;
  MessageReader reader_;
};

void tell(MessageWriter &out, const Judgement &judgement)
{
  out.send(ChildMessage::result, static_cast<char>(judgement.outcome) + judgement.words);
}

bool has(const std::string &words, const std::string &part)
{
  return words.find(part) != std::string::npos;
}

class Fuzz
{
public:
  Fuzz(const MeshTarget &target, const FuzzOptions &options) : target_(target), options_(options) {}

  Tally run(std::uint64_t from, std::uint64_t to)
  {
    while (from < to)
      from = run_in_one_process(from, std::min(to, from + of_one_process));
    return tally_;
  }

private:
  /// @return the first that was not executed
  std::uint64_t run_in_one_process(std::uint64_t from, std::uint64_t to)
  {
    Judge judge(
        [&](MessageWriter &out)
        {
          ::setenv("GESTELL_ONE_PROCESS", "1", 1);
          ::setenv("TMPDIR", folder_.path().c_str(), 1);
          hold_memory();
          for (std::uint64_t number = from; number < to; ++number)
            tell(out, fuzz::judge(write_mutation(target_, number, folder_.path()), number));
        });
    for (std::uint64_t number = from; number < to; ++number)
      if (const auto judgement = judge.next(options_.patience))
        count(number, judgement->outcome == Outcome::memory
                          ? judge_alone(write_mutation(target_, number, alone_.path()), number)
                          : *judgement);
      else
      {
        count(number, judge_alone(write_mutation(target_, number, alone_.path()), number));
        return number + 1;
      }
    return to;
  }

  void count(std::uint64_t number, const Judgement &judgement)
  {
    ++tally_.executions;
    const std::string &words = judgement.words;
    bool               kept  = true;
    switch (judgement.outcome)
    {
    case Outcome::memory: // told by no message
    case Outcome::finding:
      tally_.findings.push_back({number, words});
      std::cout << target_.name << ' ' << number << ": " << words << std::endl;
      break;
    case Outcome::long_:
      ++tally_.stopped;
      break;
    case Outcome::taken:
      ++tally_.taken;
      kept = false;
      break;
    case Outcome::refused:
      if (has(words, "reading took more than") || has(words, "out of memory"))
        ++tally_.limited;
      else if (has(words, "was ended by signal") || has(words, "ended the process"))
        ++tally_.died;
      else
      {
        ++tally_.refused;
        kept = false;
      }
    }
    if (kept && !options_.keep.empty())
      keep(number, words);
    if (options_.report_every > 0 && tally_.executions % options_.report_every == 0)
      std::cout << target_.name << ": " << tally_.text() << std::endl;
  }

  void keep(std::uint64_t number, const std::string &words) const
  {
    const files::path folder = files::path(options_.keep) / target_.name;
    files::create_directories(folder);
    const std::string file = write_mutation(target_, number, folder);
    files::rename(file, folder / (std::to_string(number) + target_.extension));
    std::ofstream(folder / "words.txt", std::ios::app) << number << ": " << words << '\n';
  }

  const MeshTarget             &target_;
  const FuzzOptions            &options_;
  const fem::TemporaryDirectory folder_, alone_;
  Tally                         tally_;
};

} // namespace

std::string Tally::text() const
{
  std::ostringstream text;
  text << executions << " executions: " << taken << " taken, " << refused << " refused, " << died
       << " deaths of gmsh told, " << limited << " ended by limits, " << stopped << " stopped while meshing, "
       << findings.size() << " findings";
  return text.str();
}

Tally fuzz(const MeshTarget &target, std::uint64_t from, std::uint64_t to, const FuzzOptions &options)
{
  return Fuzz(target, options).run(from, to);
}

Judgement judge_alone(const std::string &path, std::uint64_t number, int seconds)
{
  const fem::TemporaryDirectory folder;
  Judge                         judge(
      [&](MessageWriter &out)
      {
        ::unsetenv("GESTELL_ONE_PROCESS");
        ::setenv("GESTELL_READING_SECONDS", std::to_string(seconds).c_str(), 1);
        ::setenv("TMPDIR", folder.path().c_str(), 1);
        tell(out, fuzz::judge(path, number));
      });
  const auto judgement = judge.next(longest_alone);
  if (!judgement)
    return {Outcome::finding, "the program died, or did not end"};
  if (!files::is_empty(folder.path()))
    return {Outcome::finding, "temporary files are left"};
  return *judgement;
}

std::string write_file(const MeshTarget &target, const std::string &bytes, const std::string &folder)
{
  const std::string path = folder + "/fed" + target.extension;
  std::ofstream(path, std::ios::binary) << bytes;
  return path;
}

std::string write_mutation(const MeshTarget &target, std::uint64_t number, const std::string &folder)
{
  return write_file(target, mutated(target.seeds, number), folder);
}

} // namespace gestell::fuzz
