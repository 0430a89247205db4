#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace gestell::apps
{

/// An option as typed.
struct SpelledOption
{
  std::vector<std::string> words;       ///< "-o", "--output"; none: a positional argument
  std::string              value;       ///< "TEXT"; empty: a flag
  std::string              description; ///< without the choices
  std::vector<std::string> choices;     ///< empty: any
};

inline SpelledOption spelled(const CLI::Option &option)
{
  SpelledOption own;
  for (const std::string &name : option.get_snames())
    own.words.push_back("-" + name);
  for (const std::string &name : option.get_lnames())
    own.words.push_back("--" + name);
  if (own.words.empty())
    own.value = option.get_name(true);
  else if (option.get_items_expected_max() > 0)
    own.value = option.get_type_name().substr(0, option.get_type_name().find_first_of(":{ "));
  own.description = option.get_description();
  return own;
}

} // namespace gestell::apps
