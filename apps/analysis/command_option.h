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

  std::string              name; ///< "--jobs"; "--peers,!--no-peers" for a flag and its opposite; "KEY": positional
  Value                    value;
  std::string              does;
  Range                    range     = Range::any;
  std::vector<std::string> choices   = {};    ///< empty: any string
  std::string              needs     = "";    ///< option that is required with this one
  std::vector<std::string> proposals = {};    ///< words for completion, if this list is not the check of the value
  double                   most      = 0.;    ///< limit of a number that determines memory; 0: none
  bool                     writes    = false; ///< makes files: only for the command, not for Python

  CommandOption above_zero() const;
  CommandOption at_most(double number) const;
  CommandOption existing_file() const;
  CommandOption one_of(const std::vector<std::string> &names) const;
  CommandOption proposing(const std::vector<std::string> &words) const;
  CommandOption with(const std::string &option) const; ///< requires this option
  CommandOption of_files() const;

  /// Its name in Python and in verification cases: lead_in for "--lead-in".
  std::string key() const;

  /// Sets the value from strings as typed, several for a list; a flag accepts true, false, True, False, 1, 0 and "".
  /// @throws std::invalid_argument if a number is invalid or out of range, or for an unknown choice
  void set(const std::vector<std::string> &texts) const;
};

} // namespace gestell::apps
