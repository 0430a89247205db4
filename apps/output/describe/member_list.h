#pragma once

#include "apps/output/describe/described.h"

#include <algorithm>

namespace gestell::apps
{

/// A member of a result, for the reference.
struct MemberLine
{
  std::string path, type, unit, meaning; ///< "signals.NAME.max", "events[].t"
  bool        always = true;             ///< not only where there is something to tell
};

/// Lists the members of a described type, and of what these hold.
struct MemberList
{
  std::vector<MemberLine> &lines;
  std::string              prefix{};

  template <class T>
  void operator()(const char *name, const T &, const std::string &unit = "", const char *meaning = "")
  {
    add<T>(name, unit, meaning, true);
  }
  template <class T>
  void maybe(bool, const char *name, const T &, const std::string &unit = "", const char *meaning = "")
  {
    add<T>(name, unit, meaning, false);
  }

private:
  template <class T>
  struct Inner
  {
    using type = T;
  };
  template <class T>
  struct Inner<std::optional<T>> : Inner<T>
  {
  };

  /// "number", "array of numbers", "object"
  template <class T>
  static std::string type_name()
  {
    if constexpr (is_optional<T>)
      return type_name<typename T::value_type>() + " or null";
    else if constexpr (is_described<T> || is_pairs<T>)
      return "object";
    else if constexpr (is_list<T>)
      return "array of " + type_name<std::decay_t<decltype(*std::declval<const T &>().begin())>>() + "s";
    else if constexpr (std::is_same_v<T, bool>)
      return "boolean";
    else if constexpr (std::is_integral_v<T>)
      return "integer";
    else if constexpr (std::is_arithmetic_v<T>)
      return "number";
    else
      return "string";
  }

  template <class T>
  void inside(const std::string &at)
  {
    if constexpr (is_optional<T>)
      inside<typename T::value_type>(at);
    else if constexpr (is_described<T>)
    {
      MemberList members{lines, at + '.'};
      describe(members, T{});
    }
    else if constexpr (is_pairs<T>)
      inside<typename T::value_type::second_type>(at + ".NAME");
    else if constexpr (is_list<T>)
      inside<std::decay_t<decltype(*std::declval<const T &>().begin())>>(at + "[]");
  }

  template <class T>
  void add(const char *name, const std::string &unit, const char *meaning, bool always)
  {
    lines.push_back({prefix + name, type_name<T>(), unit, meaning, always});
    inside<T>(prefix + name);
  }
};

template <class T>
std::vector<MemberLine> members_of()
{
  std::vector<MemberLine> lines;
  MemberList              members{lines};
  describe(members, T{});
  return lines;
}

} // namespace gestell::apps
