#pragma once

#include <mpi.h>

#include <cstddef>
#include <exception>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace gestell::fem
{

/// A failure known to every rank: none is left waiting for another.
class AgreedFailure : public std::runtime_error
{
public:
  enum class Kind
  {
    none,
    wrong_input,
    method
  };
  AgreedFailure(Kind kind, const std::string &message) : std::runtime_error(message), kind(kind) {}
  Kind kind;
};

/**
 * The processes started by mpirun. Rank 0 runs the program; the others wait for its orders, which are numbers. Rank 0
 * after order(n) and all others after next_order() call the same function for n; MPI calls in it are collective on all
 * ranks. Work of a single rank that may fail must be in agree(). Waiting ranks poll shortly and then sleep, which frees
 * the processor.
 */
class Ranks
{
public:
  /// The ranks of a running MPI; one rank without MPI.
  Ranks();
  /// This process alone, whatever mpirun started.
  static Ranks alone() { return Ranks(MPI_COMM_SELF); }

  int      rank() const { return rank_; }
  int      size() const { return size_; }
  bool     first() const { return rank_ == 0; }
  MPI_Comm comm() const { return comm_; }

  /// Rank 0: sends the order to all others.
  void order(int number) const;
  /// All others: sleeps until the order of rank 0.
  int next_order() const;

  /// Does the work of this rank; collective.  @throws AgreedFailure on all ranks if the work of any of them throws.
  template <typename Work>
  void agree(const Work &work) const
  {
    std::exception_ptr failure;
    try
    {
      work();
    }
    catch (...)
    {
      failure = std::current_exception();
    }
    settle(failure);
  }

  /// The value of rank 0 for all.
  template <typename T>
  void broadcast(T &value) const
  {
    static_assert(std::is_trivially_copyable<T>::value, "bytes are sent");
    broadcast_bytes(&value, sizeof value);
  }
  void broadcast(std::string &text) const;
  void broadcast(double *values, std::ptrdiff_t count) const { broadcast_bytes(values, sizeof(double) * count); }

  /// Rank 0: x <- the sum of x on all ranks, in the order of ranks; unchanged on others.
  void sum_on_first(double *x, std::ptrdiff_t count) const;
  /// The same sum on all ranks, identical in every bit.
  void sum(double *x, std::ptrdiff_t count) const
  {
    sum_on_first(x, count);
    broadcast(x, count);
  }

  /// To one other rank, which must receive.
  template <typename T>
  void send(const std::vector<T> &values, int to) const
  {
    static_assert(std::is_trivially_copyable<T>::value, "bytes are sent");
    send_bytes(values.data(), values.size(), sizeof(T), to);
  }
  template <typename T>
  std::vector<T> receive(int from) const
  {
    std::vector<T> values(announced(from));
    receive_bytes(values.data(), values.size(), sizeof(T), from);
    return values;
  }

  /// Numbers of a known count, to one other rank; returns when they may be overwritten.
  void send(const double *values, std::ptrdiff_t count, int to) const;
  void receive(double *values, std::ptrdiff_t count, int from) const;

  /// Ends all ranks with a message on standard error; exit code 3. For a failure of one rank unknown to the others.
  [[noreturn]] void abort(const std::string &message) const;

private:
  void        settle(const std::exception_ptr &failure) const;
  void        broadcast_bytes(void *values, std::size_t size) const;
  void        send_bytes(const void *values, std::size_t count, std::size_t size, int to) const;
  std::size_t announced(int from) const;
  void        receive_bytes(void *values, std::size_t count, std::size_t size, int from) const;

  explicit Ranks(MPI_Comm comm) : comm_(comm) {}

  MPI_Comm comm_ = MPI_COMM_WORLD;
  int      rank_ = 0, size_ = 1;
};

} // namespace gestell::fem
