#include "fem/geometry/step_text.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>
#include <unordered_set>
#include <utility>
#include <vector>

namespace gestell::fem
{

namespace
{

bool is_letter(char c)
{
  return std::isalpha(static_cast<unsigned char>(c)) || c == '_';
}

bool is_digit(char c)
{
  return std::isdigit(static_cast<unsigned char>(c));
}

/// Whether the word is a value that is not a number, as programs write it: nan, -nan(ind), inf, 1.#QNAN.
bool is_no_number(std::string word)
{
  std::transform(word.begin(), word.end(), word.begin(), [](unsigned char c) { return std::toupper(c); });
  return word == "NAN" || word == "INF" || word == "INFINITY" || word == "QNAN" || word == "SNAN";
}

/// Scans the text and collects the data of StepText.
class Scan
{
public:
  explicit Scan(const std::string &text) : text_(text) {}

  StepText result()
  {
    while (at_ < text_.size())
      step();
    result_.n_entities = defined_.size();
    result_.has_unit   = has_length_ && has_context_;
    for (const auto &[entity, by] : open_)
      if (!defined_.count(entity) && result_.n_missing++ == 0)
      {
        result_.first_missing = entity;
        result_.named_by      = by;
      }
    return result_;
  }

private:
  void step()
  {
    const char c = text_[at_];
    if (c == '\'') // a doubled quote inside closes the string and opens it again
      skip_to("'", 1);
    else if (text_.compare(at_, 2, "/*") == 0)
      skip_to("*/", 2);
    else if (c == '#' && is_digit(next()))
      read_number();
    else if (is_letter(c))
      read_word();
    else
      ++at_;
  }

  char next() const { return at_ + 1 < text_.size() ? text_[at_ + 1] : ' '; }

  void skip_to(const char *end, std::size_t length)
  {
    const std::size_t found = text_.find(end, at_ + length);
    at_                     = found == std::string::npos ? text_.size() : found + length;
  }

  void read_number()
  {
    std::uint64_t number = 0;
    for (++at_; at_ < text_.size() && is_digit(text_[at_]); ++at_)
      number = 10 * number + static_cast<std::uint64_t>(text_[at_] - '0');
    std::size_t after = at_;
    while (after < text_.size() && std::isspace(static_cast<unsigned char>(text_[after])))
      ++after;
    if (after < text_.size() && text_[after] == '=')
      defined_.insert(current_ = number);
    else if (!defined_.count(number))
      open_.emplace_back(number, current_);
  }

  void read_word()
  {
    const std::size_t from = at_;
    while (at_ < text_.size() && (is_letter(text_[at_]) || is_digit(text_[at_])))
      ++at_;
    const std::string word = text_.substr(from, at_ - from);
    has_length_ |= word == "LENGTH_UNIT";
    has_context_ |= word == "GLOBAL_UNIT_ASSIGNED_CONTEXT";
    if (result_.no_number.empty() && is_no_number(word))
    {
      result_.no_number    = word;
      result_.no_number_in = current_;
    }
  }

  const std::string                                   &text_;
  std::size_t                                          at_      = 0;
  std::uint64_t                                        current_ = 0; // entity being defined
  std::unordered_set<std::uint64_t>                    defined_;
  std::vector<std::pair<std::uint64_t, std::uint64_t>> open_; // reference before its definition, and who refers
  bool                                                 has_length_ = false, has_context_ = false;
  StepText                                             result_;
};

} // namespace

StepText read_step_text(const std::string &path)
{
  std::ifstream     in(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  return Scan(text).result();
}

} // namespace gestell::fem
