#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gestell::coupling
{

/**
 * A text file of another program, in memory, line by line, with located messages.
 *
 * @throws std::invalid_argument from all of it: "frame.pch:12: 'DMIG ...': what is wrong".  Binary files are rejected
 * at once, with text formats as alternatives.
 */
class TextFile
{
public:
  explicit TextFile(const std::string &name);

  /// Steps to the next line, without its end; false at the end of the file.
  bool next();
  /// Goes back before the first line.
  void restart();

  std::string_view   line() const { return line_; }
  long               number() const { return number_; } ///< of the line, from 1
  std::size_t        size() const { return text_.size(); }
  const std::string &name() const { return name_; }

  [[noreturn]] void fail(const std::string &what) const { fail(number_, line_, what); }
  [[noreturn]] void fail_at_end(const std::string &what) const;
  [[noreturn]] void fail_at(long line, const std::string &what) const; ///< of an earlier line

  /// A finite number in the notation of C, of Fortran (1.5D+03) or in Nastran's short form (1.5-3).  @param what  its
  /// meaning, for messages
  double real(std::string_view field, const char *what) const;
  long   whole(std::string_view field, const char *what) const;
  long   node(std::string_view field) const; ///< the number of a node, from 1

private:
  [[noreturn]] void fail(long number, std::string_view line, const std::string &what) const;

  std::string      name_, text_;
  std::string_view line_;
  std::size_t      at_     = 0;
  long             number_ = 0;
};

/// A number in the notation of C, of Fortran or in Nastran's short form, infinite beyond double; none: not a number.
std::optional<double> real_of(std::string_view field);
std::optional<long>   whole_of(std::string_view field); ///< none: not an integer

std::string_view trimmed(std::string_view text);                            ///< without blanks at its ends
std::string      capitals(std::string_view text);                           ///< letters of ASCII
bool             begins(std::string_view text, std::string_view beginning); ///< independent of case

/// Words between blanks.
std::vector<std::string_view> words_of(std::string_view line);

} // namespace gestell::coupling
