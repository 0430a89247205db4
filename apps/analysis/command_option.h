#pragma once

#include <string>
#include <variant>
#include <vector>

namespace gestell::apps
{

/// An option of a command, with its name, description and checks.
struct CommandOption
{
  using Value = std::variant<bool *, int *, double *, std::string *, std::vector<std::string> *, std::vector<int> *,
                             std::vector<double> *>;
  enum class Range
  {
    any,
    above_zero,
    existing_file
  };

  std::string              name; ///< "--jobs"; "--peers,!--no-peers" of a flag with its opposite; "KEY" without a name
  Value                    value;
  std::string              does;
  Range                    range     = Range::any;
  std::vector<std::string> choices   = {};    ///< empty: any text
  std::string              needs     = "";    ///< option without which it has no meaning
  std::vector<std::string> proposals = {};    ///< words for completion, where others are refused elsewhere or are none
  double                   most      = 0.;    ///< of a number that memory grows with; 0: any
  bool                     writes    = false; ///< files: for the command alone, not for Python

  CommandOption above_zero() const;
  CommandOption at_most(double number) const;
  CommandOption existing_file() const;
  CommandOption one_of(const std::vector<std::string> &names) const;
  CommandOption proposing(const std::vector<std::string> &words) const;
  CommandOption with(const std::string &option) const; ///< needs it
  CommandOption of_files() const;

  /// Its name in Python and in verification cases: "--lead-in" is lead_in.
  std::string key() const;

  /// From texts as they are typed, several of a list; a flag by true, false, True, False, 1, 0 and "".
  /// @throws std::invalid_argument if a number is invalid or out of range, or for an unknown choice
  void set(const std::vector<std::string> &texts) const;
};

} // namespace gestell::apps
