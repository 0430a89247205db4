#pragma once

#include "apps/study/runs/rows_file.h"
#include "apps/study/runs/study_runner.h"

#include <condition_variable>
#include <mutex>

namespace gestell::apps
{

/**
 * Makes runs as they are asked for, by so many processes that threads may ask side by side; one makes them in this
 * process.
 *
 * To be made before any thread: the processes are copies of this one.
 */
class RunServer
{
public:
  /// @param stop  ends the runs, whose rows then are `waiting`
  RunServer(StudyRunner &runner, const RowsText &text, int jobs, const std::atomic<bool> &stop);
  ~RunServer();
  RunServer(const RunServer &) = delete;

  /// As StudyRunner::run(), without units; a run whose process dies has failed.
  /// @throws std::runtime_error once all processes have died
  RunRow run(int number, const Eigen::VectorXd &levels, Eigen::MatrixXd *derivatives);

private:
  struct Worker;

  void    begin_worker();
  Worker *free_worker();
  void    give_back(Worker *worker, bool lives);
  RunRow  requested(Worker &worker, int number, const Eigen::VectorXd &levels, Eigen::MatrixXd *derivatives,
                    bool &lives);
  bool    read_whole(int pipe, void *bytes, std::size_t size);

  StudyRunner                         &runner_;
  const RowsText                      &text_;
  const std::atomic<bool>             &stop_;
  std::atomic<bool>                   *stop_of_workers_ = nullptr; ///< in memory that they share
  std::vector<std::unique_ptr<Worker>> workers_;                   ///< none: this process makes the runs
  std::vector<Worker *>                free_;
  std::mutex                           mutex_;
  std::condition_variable              given_back_;
  std::size_t                          n_living_ = 0;
};

} // namespace gestell::apps
