#include "fem/ranks.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <iostream>
#include <new>
#include <sched.h>
#include <thread>

namespace gestell::fem
{

namespace
{

using Kind = AgreedFailure::Kind;

enum Tag
{
  tag_order = 7070, // beside those of libraries on the same communicator
  tag_count,
  tag_values
};

constexpr int         exit_failed = 3;
constexpr std::size_t at_once     = std::size_t(1) << 27; // bytes of one message: MPI counts with int

/// The kind of a failure, and its message.
std::pair<Kind, std::string> told(const std::exception_ptr &failure)
{
  if (!failure)
    return {Kind::none, ""};
  try
  {
    std::rethrow_exception(failure);
  }
  catch (const std::invalid_argument &error)
  {
    return {Kind::wrong_input, error.what()};
  }
  catch (const std::bad_alloc &)
  {
    return {Kind::method, "memory is short; start more ranks on more machines, or use a coarser mesh"};
  }
  catch (const std::exception &error)
  {
    return {Kind::method, error.what()};
  }
  catch (...)
  {
    return {Kind::method, "unknown failure"};
  }
}

} // namespace

Ranks::Ranks()
{
  int begun = 0, ended = 0;
  MPI_Initialized(&begun);
  MPI_Finalized(&ended);
  if (!begun || ended)
    return;
  MPI_Comm_rank(comm(), &rank_);
  MPI_Comm_size(comm(), &size_);
}

void Ranks::order(int number) const
{
  for (int other = 1; other < size_; ++other)
    MPI_Send(&number, 1, MPI_INT, other, tag_order, comm());
}

int Ranks::next_order() const
{
  using Clock = std::chrono::steady_clock;
  // Orders follow each other closely or not at all: a moment of polling, then sleep, which leaves the processor to
  // rank 0.
  const auto begin = Clock::now();
  for (int arrived = 0;;)
  {
    MPI_Iprobe(0, tag_order, comm(), &arrived, MPI_STATUS_IGNORE);
    if (arrived)
      break;
    if (Clock::now() - begin < std::chrono::milliseconds(2))
      sched_yield();
    else
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  int number = 0;
  MPI_Recv(&number, 1, MPI_INT, 0, tag_order, comm(), MPI_STATUS_IGNORE);
  return number;
}

void Ranks::settle(const std::exception_ptr &failure) const
{
  auto [kind, message] = told(failure);
  int lowest           = kind == Kind::none ? size_ : rank_; // rank that speaks for all
  MPI_Allreduce(MPI_IN_PLACE, &lowest, 1, MPI_INT, MPI_MIN, comm());
  if (lowest == size_)
    return;
  MPI_Bcast(&kind, sizeof kind, MPI_BYTE, lowest, comm());
  std::size_t length = message.size();
  MPI_Bcast(&length, sizeof length, MPI_BYTE, lowest, comm());
  message.resize(length);
  MPI_Bcast(message.data(), int(length), MPI_CHAR, lowest, comm());
  if (lowest > 0)
    message += " (rank " + std::to_string(lowest) + " of " + std::to_string(size_) + ")";
  throw AgreedFailure(kind, message);
}

void Ranks::broadcast(std::string &text) const
{
  std::size_t length = text.size();
  broadcast(length);
  text.resize(length);
  MPI_Bcast(text.data(), int(length), MPI_CHAR, 0, comm());
}

void Ranks::send_bytes(const void *values, std::size_t count, std::size_t size, int to) const
{
  MPI_Send(&count, sizeof count, MPI_BYTE, to, tag_count, comm());
  const auto *bytes = static_cast<const char *>(values);
  for (std::size_t first = 0; first < count * size; first += at_once)
    MPI_Send(bytes + first, int(std::min(at_once, count * size - first)), MPI_BYTE, to, tag_values, comm());
}

std::size_t Ranks::announced(int from) const
{
  std::size_t count = 0;
  MPI_Recv(&count, sizeof count, MPI_BYTE, from, tag_count, comm(), MPI_STATUS_IGNORE);
  return count;
}

void Ranks::receive_bytes(void *values, std::size_t count, std::size_t size, int from) const
{
  auto *bytes = static_cast<char *>(values);
  for (std::size_t first = 0; first < count * size; first += at_once)
    MPI_Recv(bytes + first, int(std::min(at_once, count * size - first)), MPI_BYTE, from, tag_values, comm(),
             MPI_STATUS_IGNORE);
}

void Ranks::abort(const std::string &message) const
{
  std::cerr << "gestell: the computation failed on rank " << rank_ << " of " << size_ << ": " << message << std::endl;
  MPI_Abort(comm(), exit_failed);
  std::abort(); // MPI_Abort does not return
}

} // namespace gestell::fem
