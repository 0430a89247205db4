#include "fem/values/geo_tokens.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <regex>

namespace gestell::fem
{

namespace
{

/// Signs of two and three characters, the longest first; all others have one.
constexpr std::array<const char *, 16> long_signs = {
    "...", "+=", "-=", "*=", "/=", "++", "--", "==", "!=", "<=", ">=", ">>", "<<", "::", "||", "&&"};
constexpr const char *signs = ";,=+-*/%^()[]{}.:?!<>&|#~";

bool is_letter(char c)
{
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

bool is_digit(char c)
{
  return c >= '0' && c <= '9';
}

/// Whether the text ends a skipped block: gmsh compares letters there, without regard to their context.
bool ends_a_block(const std::string &text)
{
  static const std::regex words("(Return|EndFor|EndIf|ElseIf|Else)(?![A-Za-z_])");
  return std::regex_search(text, words);
}

bool is_block_word(const std::string &word)
{
  return word == "Return" || word == "EndFor" || word == "EndIf" || word == "ElseIf" || word == "Else";
}

/// "%g" and its like, for one number: gmsh hands texts to the C library's printf.
bool is_safe_format(const std::string &text)
{
  static const std::regex format("%([-+ #0]*[0-9]{0,2}(\\.[0-9]{0,2})?[eEfFgG]|%)");
  const std::string       rest = std::regex_replace(text, format, "");
  return rest.find('%') == std::string::npos;
}

class GeoScanner
{
public:
  GeoScanner(const std::string &script, const RefuseLine &refuse) : script_(script), refuse_(refuse) {}

  std::vector<GeoToken> tokens()
  {
    while (skip_blanks())
      next();
    return std::move(tokens_);
  }

private:
  char at(std::size_t i) const { return i < script_.size() ? script_[i] : '\0'; }

  void add(GeoToken::Kind kind, std::size_t length)
  {
    tokens_.push_back({kind, script_.substr(here_, length), line_});
    here_ += length;
  }

  /// @return whether a token follows
  bool skip_blanks()
  {
    while (here_ < script_.size())
      if (at(here_) == '/' && at(here_ + 1) == '/')
        here_ = std::min(script_.find('\n', here_), script_.size());
      else if (at(here_) == '/' && at(here_ + 1) == '*')
        skip_comment();
      else if (std::string(" \t\n\r\f").find(at(here_)) != std::string::npos && at(here_) != '\0')
        line_ += at(here_++) == '\n';
      else
        return true;
    return false;
  }

  void skip_comment()
  {
    const std::size_t end = script_.find("*/", here_ + 2);
    if (end == std::string::npos)
      refuse_(line_, "begins a comment that does not end");
    line_ += static_cast<int>(std::count(script_.begin() + static_cast<std::ptrdiff_t>(here_),
                                         script_.begin() + static_cast<std::ptrdiff_t>(end), '\n'));
    here_ = end + 2;
  }

  void next()
  {
    const char c = at(here_);
    if (is_letter(c))
      read_word();
    else if (is_digit(c) || (c == '.' && is_digit(at(here_ + 1))))
      read_number();
    else if (c == '"' || c == '\'')
      read_text(c);
    else
      read_sign();
  }

  void read_word()
  {
    std::size_t n = 1;
    while (is_letter(at(here_ + n)) || is_digit(at(here_ + n)))
      ++n;
    add(GeoToken::Kind::word, n);
    const std::string &word = tokens_.back().text;
    if (ends_a_block(word) && !is_block_word(word))
      refuse_(line_, "has the name \"" + word + "\", which gmsh may read as the end of a block; choose another name");
  }

  std::size_t digits(std::size_t n) const
  {
    while (is_digit(at(here_ + n)))
      ++n;
    return n;
  }

  void read_number()
  {
    std::size_t n = digits(0);
    if (at(here_ + n) == '.')
      n = digits(n + 1);
    const std::size_t sign = at(here_ + n + 1) == '+' || at(here_ + n + 1) == '-' ? 1 : 0;
    if ((at(here_ + n) == 'e' || at(here_ + n) == 'E') && is_digit(at(here_ + n + 1 + sign)))
      n = digits(n + 1 + sign);
    add(GeoToken::Kind::number, n);
  }

  void read_text(char quote)
  {
    const std::size_t end = script_.find(quote, here_ + 1);
    if (end == std::string::npos)
      refuse_(line_, "begins a string that does not end");
    const std::string     text         = script_.substr(here_ + 1, end - here_ - 1);
    constexpr std::size_t longest_text = 1000; // gmsh's buffer has 1024 bytes
    if (text.size() > longest_text)
      refuse_(line_, "has a string of more than " + std::to_string(longest_text) + " bytes, which gmsh truncates");
    if (std::any_of(text.begin(), text.end(), [](unsigned char c) { return c < ' ' && c != '\t'; }))
      refuse_(line_, "has a string over several lines, or with characters that do not print");
    if (ends_a_block(text))
      refuse_(line_, "has the string \"" + text + "\", which gmsh may read as the end of a block; use other words");
    if (!is_safe_format(text))
      refuse_(line_,
              "has the string \"" + text + "\", whose % is not a format of one number such as %g; write %% for a %");
    tokens_.push_back({GeoToken::Kind::text, text, line_});
    here_ = end + 1;
  }

  void read_sign()
  {
    for (const char *sign : long_signs)
      if (script_.compare(here_, std::string(sign).size(), sign) == 0)
        return add(GeoToken::Kind::sign, std::string(sign).size());
    if (at(here_) == '\0' || std::string(signs).find(at(here_)) == std::string::npos)
      refuse_(line_, "has a character that is not part of gmsh's language" +
                         (at(here_) > ' ' ? std::string(": ") + at(here_) : std::string()));
    add(GeoToken::Kind::sign, 1);
  }

  const std::string    &script_;
  const RefuseLine     &refuse_;
  std::size_t           here_ = 0;
  int                   line_ = 1;
  std::vector<GeoToken> tokens_;
};

} // namespace

std::vector<GeoToken> geo_tokens(const std::string &script, const RefuseLine &refuse)
{
  return GeoScanner(script, refuse).tokens();
}

std::string geo_text(const std::vector<GeoToken> &tokens)
{
  std::string text;
  int         line = 1;
  for (const GeoToken &token : tokens)
  {
    text.append(static_cast<std::size_t>(token.line - line), '\n');
    line = token.line;
    if (token.kind == GeoToken::Kind::text)
    {
      const char quote = token.text.find('"') == std::string::npos ? '"' : '\'';
      text += quote + token.text + quote + ' ';
    }
    else
      text += token.text + ' ';
  }
  return text + '\n';
}

bool begins_as_mesh(const std::string &file)
{
  constexpr std::array<const char *, 6> beginnings = {"$MeshFormat", "$Comments", "$NO", "$ELM", "$PTS", "$PARA"};
  std::string                           head(16, '\0');
  std::ifstream(file, std::ios::binary).read(head.data(), static_cast<std::streamsize>(head.size()));
  return std::any_of(beginnings.begin(), beginnings.end(),
                     [&](const char *beginning) { return head.compare(0, std::strlen(beginning), beginning) == 0; });
}

} // namespace gestell::fem
