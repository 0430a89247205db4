#pragma once

#include "coupling/integration/system/announced_size.h"
#include "coupling/integration/system/time_integrator.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace gestell::coupling
{

class StateArchive;

void exchange(StateArchive &archive, LocalState &state);
void exchange(StateArchive &archive, Instant &instant);

template <typename T, typename = void>
struct ExchangesItself : std::false_type
{
};
template <typename T>
struct ExchangesItself<T, std::void_t<decltype(std::declval<T &>().exchange(std::declval<StateArchive &>()))>>
    : std::true_type
{
};

template <typename T, typename = void>
struct ExchangedBeside : std::false_type
{
};
template <typename T>
struct ExchangedBeside<T, std::void_t<decltype(exchange(std::declval<StateArchive &>(), std::declval<T &>()))>>
    : std::true_type
{
};

/**
 * The state of a computation as bytes: one list of members both writes and reads it, so that the two cannot differ.
 *
 *     void exchange(StateArchive &archive) { archive(q_, v_, step_, points_); }
 *
 * Supported are numbers, flags, plain structs of these, strings, Eigen's matrices, vectors and arrays of them, and
 * types with a member exchange() or a function exchange(StateArchive &, T &).  Bytes have the format of this processor;
 * the code that stores them records for which program and which computation they are valid.  Sizes that are read are
 * checked against the remaining bytes before memory is allocated.
 */
class StateArchive
{
public:
  StateArchive() = default; ///< for writing
  explicit StateArchive(std::string bytes) : bytes_(std::move(bytes)), reads_(true) {}

  bool               reads() const { return reads_; }
  const std::string &bytes() const { return bytes_; }
  bool               at_end() const { return place_ == bytes_.size(); }

  template <typename... Members>
  void operator()(Members &...members)
  {
    (one(members), ...);
  }

private:
  template <typename T>
  void one(T &member)
  {
    if constexpr (ExchangesItself<T>::value)
      member.exchange(*this);
    else if constexpr (ExchangedBeside<T>::value)
      exchange(*this, member);
    else if constexpr (std::is_base_of_v<Eigen::PlainObjectBase<T>, T>)
      matrix(member);
    else if constexpr (std::is_array_v<T>)
      for (auto &entry : member)
        one(entry);
    else
    {
      static_assert(std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>, "give it a function exchange()");
      raw(&member, sizeof member);
    }
  }
  template <typename T, std::size_t n>
  void one(std::array<T, n> &members)
  {
    for (T &member : members)
      one(member);
  }
  template <typename T>
  void one(std::vector<T> &members)
  {
    const std::size_t n = count(members.size(), std::is_arithmetic_v<T> ? sizeof(T) : 1);
    if constexpr (std::is_arithmetic_v<T>)
    {
      members.resize(n);
      raw(members.data(), n * sizeof(T));
    }
    else
    {
      members.resize(std::min(n, members.size()));
      for (std::size_t i = 0; i < n; ++i) // grows while reading, because an entry may take more memory than bytes
      {
        if (i == members.size())
          members.emplace_back();
        one(members[i]);
      }
    }
  }
  void one(std::string &text)
  {
    text.resize(count(text.size(), 1));
    raw(text.data(), text.size());
  }

  template <typename Matrix>
  void matrix(Matrix &x)
  {
    const std::size_t rows = count(std::size_t(x.rows()), 0), columns = count(std::size_t(x.cols()), 0);
    if (reads_ &&
        (!is_shape<Matrix>(rows, columns) || !stand_in(left(), rows, columns, sizeof(typename Matrix::Scalar))))
      fail();
    x.resize(Eigen::Index(rows), Eigen::Index(columns));
    raw(x.data(), rows * columns * sizeof(typename Matrix::Scalar));
  }

  /// Whether the scalar type matches and no index of the matrix overflows.
  template <typename Matrix>
  static bool is_shape(std::size_t rows, std::size_t columns)
  {
    const auto may_be = [](std::size_t n, int fixed)
    { return fixed == Eigen::Dynamic ? n <= std::size_t(PTRDIFF_MAX) : n == std::size_t(fixed); };
    return may_be(rows, Matrix::RowsAtCompileTime) && may_be(columns, Matrix::ColsAtCompileTime);
  }

  std::size_t count(std::size_t n, std::size_t bytes_of_each)
  {
    raw(&n, sizeof n);
    if (reads_ && !stand_in(left(), n, bytes_of_each))
      fail();
    return n;
  }

  void raw(void *data, std::size_t size)
  {
    if (!reads_)
    {
      bytes_.append(static_cast<const char *>(data), size);
      return;
    }
    if (size > left())
      fail();
    if (size > 0)
      std::memcpy(data, bytes_.data() + place_, size);
    place_ += size;
  }

  std::size_t left() const { return bytes_.size() - place_; } ///< to read

  [[noreturn]] static void fail() { throw std::runtime_error("the stored state ends early"); }

  std::string bytes_;
  std::size_t place_ = 0;
  bool        reads_ = false;
};

inline void exchange(StateArchive &archive, LocalState &state)
{
  archive(state.t, state.u, state.v, state.a, state.p, state.lambda);
}

inline void exchange(StateArchive &archive, Instant &instant)
{
  archive(instant.t, instant.q, instant.v, instant.local);
}

} // namespace gestell::coupling
