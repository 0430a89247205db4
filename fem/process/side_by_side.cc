#include "fem/process/side_by_side.h"

#include "fem/process/ended_by_signal.h"

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <vector>

namespace gestell::fem
{

namespace
{

/// What the threads tell the one that waits for them.
class Common
{
public:
  Common(int n, int at_once) : n_(n), running_(at_once) {}

  /// The next number, or -1: there is none, or something has failed.
  int next()
  {
    const std::lock_guard<std::mutex> alone(mutex_);
    return failure_ || next_ == n_ ? -1 : next_++;
  }
  void report(const std::string &phase)
  {
    const std::lock_guard<std::mutex> alone(mutex_);
    if (failure_)
      throw std::runtime_error("ended, because another one failed");
    phase_ = phase;
  }
  void finish_one()
  {
    const std::lock_guard<std::mutex> alone(mutex_);
    ++done_;
  }
  void fail(std::exception_ptr failure)
  {
    const std::lock_guard<std::mutex> alone(mutex_);
    if (!failure_)
      failure_ = std::move(failure);
  }
  void leave()
  {
    const std::lock_guard<std::mutex> alone(mutex_);
    --running_;
    changed_.notify_all();
  }

  /// Until all threads have left.
  void wait(const ChildProgress &progress)
  {
    constexpr std::chrono::milliseconds told_again{100}; // as in_child()
    for (std::unique_lock<std::mutex> alone(mutex_); running_ > 0;)
    {
      changed_.wait_for(alone, told_again);
      if (!progress || failure_ || phase_.empty())
        continue;
      const std::string phase = phase_;
      const double      share = double(done_) / n_;
      alone.unlock();
      try
      {
        progress(phase, share);
      }
      catch (...)
      {
        fail(std::current_exception());
      }
      alone.lock();
    }
  }
  void rethrow() const
  {
    if (failure_)
      std::rethrow_exception(failure_);
  }

private:
  int                     n_, next_ = 0, done_ = 0, running_;
  std::string             phase_;
  std::exception_ptr      failure_;
  std::mutex              mutex_;
  std::condition_variable changed_;
};

} // namespace

void side_by_side(int n, int at_once, const ChildProgress &progress,
                  const std::function<void(int, const ChildProgress &)> &work)
{
  if (at_once < 2 || n < 2)
  {
    for (int i = 0; i < n; ++i)
      work(i,
           [&](const std::string &phase, double)
           {
             if (progress)
               progress(phase, double(i) / n);
           });
    return;
  }
  const EndedBySignal      ended; // obeyed when all children are gone
  Common                   common(n, at_once);
  std::vector<std::thread> threads;
  const auto               run = [&]
  {
    try
    {
      for (int i = common.next(); i >= 0; i = common.next())
      {
        work(i, [&](const std::string &phase, double) { common.report(phase); });
        common.finish_one();
      }
    }
    catch (...)
    {
      common.fail(std::current_exception());
    }
    common.leave();
  };
  for (int k = 0; k < at_once; ++k)
    try
    {
      threads.emplace_back(run);
    }
    catch (const std::system_error &) // no more threads
    {
      if (k == 0)
        common.fail(std::current_exception());
      common.leave();
    }
  common.wait(progress);
  for (std::thread &thread : threads)
    thread.join();
  common.rethrow();
}

} // namespace gestell::fem
