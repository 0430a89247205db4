#include "fem/parallel/ranks.h"

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
  tag_order = 7070, // other than those of libraries on the same communicator
  tag_count,
  tag_values
};

constexpr std::size_t at_once = std::size_t(1) << 27; // bytes of one message: MPI counts with int

using Clock = std::chrono::steady_clock;

/// Calls arrived() until it is so: a moment of polling, in which messages of a step in common arrive, then with sleep
/// in between.
template <typename Arrived>
void await(const Arrived &arrived, std::chrono::microseconds polling, std::chrono::microseconds sleep)
{
  for (const auto begin = Clock::now(); !arrived();)
    if (Clock::now() - begin < polling)
      sched_yield();
    else
      std::this_thread::sleep_for(sleep);
}

void await(MPI_Request request)
{
  await(
      [&]
      {
        int arrived = 0;
        MPI_Test(&request, &arrived, MPI_STATUS_IGNORE);
        return arrived != 0;
      },
      std::chrono::microseconds(200), std::chrono::microseconds(50));
}

void send_message(MPI_Comm comm, const void *bytes, std::size_t size, Tag tag, int to)
{
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Isend(bytes, int(size), MPI_BYTE, to, tag, comm, &request);
  await(request);
}

void receive_message(MPI_Comm comm, void *bytes, std::size_t size, Tag tag, int from)
{
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Irecv(bytes, int(size), MPI_BYTE, from, tag, comm, &request);
  await(request);
}

void send_values(MPI_Comm comm, const void *values, std::size_t size, int to)
{
  for (std::size_t first = 0; first < size; first += at_once)
    send_message(comm, static_cast<const char *>(values) + first, std::min(at_once, size - first), tag_values, to);
}

void receive_values(MPI_Comm comm, void *values, std::size_t size, int from)
{
  for (std::size_t first = 0; first < size; first += at_once)
    receive_message(comm, static_cast<char *>(values) + first, std::min(at_once, size - first), tag_values, from);
}

/// The kind of a failure, and its message.
std::pair<Kind, std::string> described(const std::exception_ptr &failure)
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
    return {Kind::method, "not enough memory; start more ranks on more computers, or use a coarser mesh"};
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
  await(
      [&]
      {
        int arrived = 0;
        MPI_Iprobe(0, tag_order, comm(), &arrived, MPI_STATUS_IGNORE);
        return arrived != 0;
      },
      std::chrono::milliseconds(2), std::chrono::milliseconds(1));
  int number = 0;
  MPI_Recv(&number, 1, MPI_INT, 0, tag_order, comm(), MPI_STATUS_IGNORE);
  return number;
}

void Ranks::settle(const std::exception_ptr &failure) const
{
  auto [kind, message] = described(failure);
  if (size_ == 1 && kind != Kind::none)
    throw AgreedFailure(kind, message);
  if (size_ == 1)
    return;
  int         lowest  = kind == Kind::none ? size_ : rank_; // rank that speaks for all
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Iallreduce(MPI_IN_PLACE, &lowest, 1, MPI_INT, MPI_MIN, comm(), &request);
  await(request);
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
  broadcast_bytes(text.data(), length);
}

void Ranks::broadcast_bytes(void *values, std::size_t size) const
{
  if (size_ == 1)
    return;
  for (std::size_t first = 0; first < size; first += at_once)
  {
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Ibcast(static_cast<char *>(values) + first, int(std::min(at_once, size - first)), MPI_BYTE, 0, comm(),
               &request);
    await(request);
  }
}

void Ranks::sum_on_first(double *x, std::ptrdiff_t count) const
{
  if (rank_ > 0)
    return send(x, count, 0);
  std::vector<double> other(size_ > 1 ? count : 0);
  for (int rank = 1; rank < size_; ++rank)
  {
    receive(other.data(), count, rank);
    for (std::ptrdiff_t i = 0; i < count; ++i)
      x[i] += other[i];
  }
}

void Ranks::send(const double *values, std::ptrdiff_t count, int to) const
{
  send_values(comm(), values, sizeof(double) * count, to);
}

void Ranks::receive(double *values, std::ptrdiff_t count, int from) const
{
  receive_values(comm(), values, sizeof(double) * count, from);
}

void Ranks::send_bytes(const void *values, std::size_t count, std::size_t size, int to) const
{
  send_message(comm(), &count, sizeof count, tag_count, to);
  send_values(comm(), values, count * size, to);
}

std::size_t Ranks::announced(int from) const
{
  std::size_t count = 0;
  receive_message(comm(), &count, sizeof count, tag_count, from);
  return count;
}

void Ranks::receive_bytes(void *values, std::size_t count, std::size_t size, int from) const
{
  receive_values(comm(), values, count * size, from);
}

void Ranks::abort(const std::string &message) const
{
  // At one go: std::cerr writes piece by piece, between which the words of other ranks and of the launcher fall.
  const std::string line = "gestell: the computation failed on rank " + std::to_string(rank_) + " of " +
                           std::to_string(size_) + ": " + message + '\n';
  std::cerr << line << std::flush;
  // mpirun of Open MPI 5 drops what it has not passed on when a rank aborts.
  constexpr std::chrono::milliseconds forwarded{500};
  std::this_thread::sleep_for(forwarded);
  constexpr int exit_failed = 3; // as the program's own: the computation failed
  MPI_Abort(comm(), exit_failed);
  std::abort(); // MPI_Abort does not return
}

} // namespace gestell::fem
