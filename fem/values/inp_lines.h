#pragma once

#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace gestell::fem
{

/// *KEYWORD, NAME=value, FLAG; names in capitals, values unchanged, without quotation marks.
struct InpKeyword
{
  std::string                        name;
  std::map<std::string, std::string> parameters;

  /// "" if it is missing or has no value.
  std::string operator[](const std::string &parameter) const;
  bool        has(const std::string &parameter) const { return parameters.count(parameter) > 0; }
};

/// The lines of an input file of Abaqus or CalculiX, without empty lines and comments (**), and without trailing
/// blanks.  A keyword line that ends with a comma continues in the next line if that begins with a letter.
class InpLines
{
public:
  explicit InpLines(const std::string &path);

  bool opened() const { return opened_; }

  /// Steps to the next line; false at the end of the file.
  /// @throws std::invalid_argument with the location of a line of more than a million characters.
  bool next();

  int                      number() const { return number_; } ///< of the line in the file, from 1
  const std::string       &text() const { return text_; }
  bool                     is_keyword() const { return text_[0] == '*'; }
  InpKeyword               keyword() const;
  std::vector<std::string> fields() const; ///< between commas; without empty ones at the end

private:
  bool take();

  std::string   path_;
  std::ifstream in_;
  bool          opened_;
  int           number_ = 0, read_ = 0;
  std::string   text_, ahead_;
  bool          has_ahead_ = false;
};

/// The file from which a keyword reads lines, relative to the folder of `file`: that of *INCLUDE, and of INPUT= for
/// nodes, elements, sets or surfaces; "" for any other.
std::string input_of(const InpKeyword &keyword, const std::string &file);

/// Upper case, since names are case-insensitive.
std::string in_capitals(std::string text);

} // namespace gestell::fem
