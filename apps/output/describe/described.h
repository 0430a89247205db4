#pragma once

#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace gestell::apps
{

/**
 * A result lists its members once, next to its struct; visitors write them as JSON, as rows of a table and as lines of
 * the reference:
 *
 *     template <class Visitor>
 *     void describe(Visitor &v, const LoadDuration &x)
 *     {
 *       v("begin", x.begin, "s", "first instant above 1 % of the peak");
 *       v("peak", x.peak, x.unit, "largest force");
 *       v("modes", by_name(x.modes, &LoadOnMode::name), "", "modes that it excites");
 *     }
 *
 *     v(name, value, unit, meaning)
 *     v.maybe(is, name, value, unit, meaning)   absent where `is` is false
 *
 * A value is a number, a boolean, a string, a described value, a list of values, pairs of a name and a value, or a
 * std::optional of these. An empty optional and a number that is not finite become null. An expression of members may
 * replace a member; it must be valid for a value-initialised result, because the reference is generated from one.
 */
struct AnyVisitor
{
  template <class... Any>
  void operator()(Any &&...)
  {
  }
  template <class... Any>
  void maybe(Any &&...)
  {
  }
};

template <class T, class = void>
inline constexpr bool is_described = false;
template <class T>
inline constexpr bool
    is_described<T, std::void_t<decltype(describe(std::declval<AnyVisitor &>(), std::declval<const T &>()))>> = true;

template <class T>
inline constexpr bool is_optional = false;
template <class T>
inline constexpr bool is_optional<std::optional<T>> = true;

template <class T>
inline constexpr bool is_pairs = false;
template <class T>
inline constexpr bool is_pairs<std::vector<std::pair<std::string, T>>> = true;

template <class T, class = void>
inline constexpr bool is_list = false;
template <class T>
inline constexpr bool is_list<T, std::void_t<decltype(std::declval<const T &>().begin())>> =
    !std::is_convertible_v<const T &, std::string> && !is_pairs<T>;

/// Null for an empty string.
inline std::optional<std::string> unless_empty(const std::string &text)
{
  return text.empty() ? std::nullopt : std::optional(text);
}

/// Null for zero.
inline std::optional<double> unless_zero(double x)
{
  return x == 0. ? std::nullopt : std::optional(x);
}

/// Pairs of the name of each item and the item.
template <class T, class NameOf>
std::vector<std::pair<std::string, T>> by_name(const std::vector<T> &items, NameOf name_of)
{
  std::vector<std::pair<std::string, T>> pairs;
  for (const T &item : items)
    pairs.emplace_back(std::invoke(name_of, item), item);
  return pairs;
}

/// Pairs of names and values.
template <class Names, class Values>
std::vector<std::pair<std::string, double>> pairs_of(const Names &names, const Values &values)
{
  std::vector<std::pair<std::string, double>> pairs;
  auto                                        value = values.begin();
  for (const auto &name : names)
    pairs.emplace_back(name, *value++);
  return pairs;
}

} // namespace gestell::apps
