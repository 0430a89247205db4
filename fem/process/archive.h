#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <map>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace gestell::fem
{

/**
 * Visits all members of a value: numbers, strings, arrays, vectors, maps, and values with a
 *
 *     template <typename Archive> void exchange(Archive &archive, Value &value)
 *
 * that passes all members to archive(...). Use a structured binding there: a forgotten new member then does not
 * compile.
 *
 * @tparam Derived  has run(first, n), for contiguous numbers, and size(n), for a number of elements.
 */
template <typename Derived>
class Archive
{
public:
  template <typename... Values>
  void operator()(Values &...values)
  {
    (one(values), ...);
  }

private:
  Derived &self() { return static_cast<Derived &>(*this); }

  template <typename T>
  static constexpr bool is_number = std::is_arithmetic_v<T> || std::is_enum_v<T>;

  template <typename T>
  void one(T &value)
  {
    if constexpr (is_number<T>)
      self().run(&value, 1);
    else
      exchange(self(), value);
  }
  void one(std::string &text)
  {
    resize(text);
    self().run(text.data(), text.size());
  }
  template <typename T, std::size_t n>
  void one(std::array<T, n> &array)
  {
    all(array.data(), n);
  }
  template <typename T>
  void one(std::vector<T> &vector)
  {
    resize(vector);
    all(vector.data(), vector.size());
  }
  template <typename First, typename Second>
  void one(std::pair<First, Second> &pair)
  {
    one(pair.first);
    one(pair.second);
  }
  template <typename Key, typename Value>
  void one(std::map<Key, Value> &map)
  {
    std::vector<std::pair<Key, Value>> entries(map.begin(), map.end());
    one(entries);
    map = {entries.begin(), entries.end()};
  }

  template <typename T>
  void all(T *first, std::size_t n)
  {
    if constexpr (is_number<T>)
      self().run(first, n);
    else
      for (std::size_t i = 0; i < n; ++i)
        one(first[i]);
  }
  template <typename T, std::size_t m>
  void all(std::array<T, m> *first, std::size_t n)
  {
    if constexpr (is_number<T>)
      self().run(n > 0 ? first->data() : nullptr, n * m); // consecutive
    else
      for (std::size_t i = 0; i < n; ++i)
        one(first[i]);
  }
  template <typename Container>
  void resize(Container &container)
  {
    std::size_t n = container.size();
    self().size(n);
    container.resize(n);
  }
};

class ByteWriter : public Archive<ByteWriter>
{
public:
  template <typename T>
  void run(const T *first, std::size_t n)
  {
    bytes_.append(reinterpret_cast<const char *>(first), n * sizeof(T));
  }
  void size(std::size_t n) { run(&n, 1); }

  std::string take() { return std::move(bytes_); }

private:
  std::string bytes_;
};

/// @throws std::runtime_error if there are too few bytes
class ByteReader : public Archive<ByteReader>
{
public:
  explicit ByteReader(const std::string &bytes) : bytes_(bytes) {}

  template <typename T>
  void run(T *first, std::size_t n)
  {
    require(n <= (bytes_.size() - at_) / sizeof(T));
    if (n > 0)
      std::memcpy(first, bytes_.data() + at_, n * sizeof(T));
    at_ += n * sizeof(T);
  }
  void size(std::size_t &n)
  {
    run(&n, 1);
    require(n <= bytes_.size() - at_); // every member takes at least one byte
  }

private:
  static void require(bool enough)
  {
    if (!enough)
      throw std::runtime_error("in_child: the result is cut off");
  }

  const std::string &bytes_;
  std::size_t        at_ = 0;
};

/// Whether all real numbers in a value are finite.
class FiniteNumbers : public Archive<FiniteNumbers>
{
public:
  template <typename T>
  void run(const T *first, std::size_t n)
  {
    if constexpr (std::is_floating_point_v<T>)
      for (std::size_t i = 0; i < n; ++i)
        all_ = all_ && std::isfinite(first[i]);
  }
  void size(std::size_t) {}

  bool all() const { return all_; }

private:
  bool all_ = true;
};

template <typename Value>
std::string bytes_of(Value &value)
{
  ByteWriter writer;
  writer(value);
  return writer.take();
}

template <typename Value>
Value value_of(const std::string &bytes)
{
  Value      value;
  ByteReader reader(bytes);
  reader(value);
  return value;
}

template <typename Value>
bool is_finite(Value &value)
{
  FiniteNumbers numbers;
  numbers(value);
  return numbers.all();
}

} // namespace gestell::fem
