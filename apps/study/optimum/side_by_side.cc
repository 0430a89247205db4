#include "apps/study/optimum/side_by_side.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace gestell::apps
{

void side_by_side(int n, int threads, const std::function<void(int)> &task)
{
  std::atomic<int>   next{0};
  std::mutex         mutex;
  std::exception_ptr failure;
  const auto         work = [&]
  {
    for (int i = next++; i < n; i = next++)
      try
      {
        task(i);
      }
      catch (...)
      {
        const std::lock_guard<std::mutex> alone(mutex);
        if (!failure)
          failure = std::current_exception();
        next = n;
      }
  };
  std::vector<std::thread> others;
  for (int i = 1; i < std::min(n, threads); ++i)
    others.emplace_back(work);
  work();
  for (std::thread &other : others)
    other.join();
  if (failure)
    std::rethrow_exception(failure);
}

} // namespace gestell::apps
