#include "fem/values/inp_lines.h"

#include "fem/values/trimmed.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <stdexcept>

namespace gestell::fem
{

namespace
{

/// bytes: no program writes as many; a binary file may have no end of line
constexpr std::size_t longest_line = 1000000;

std::string unquoted(const std::string &text)
{
  return text.size() > 1 && text.front() == '"' && text.back() == '"' ? text.substr(1, text.size() - 2) : text;
}

std::vector<std::string> fields_of(const std::string &line)
{
  std::vector<std::string> fields;
  for (std::size_t from = 0; from <= line.size();)
  {
    const std::size_t comma = std::min(line.find(',', from), line.size());
    fields.push_back(trimmed(line.substr(from, comma - from)));
    from = comma + 1;
  }
  while (!fields.empty() && fields.back().empty()) // after a comma the next line continues
    fields.pop_back();
  return fields;
}

} // namespace

std::string in_capitals(std::string text)
{
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::toupper(c); });
  return text;
}

std::string InpKeyword::operator[](const std::string &parameter) const
{
  const auto found = parameters.find(parameter);
  return found == parameters.end() ? "" : found->second;
}

InpLines::InpLines(const std::string &path)
    : path_(path), in_(path), opened_(in_ && std::filesystem::is_regular_file(path))
{
}

/// The next line into ahead_.
bool InpLines::take()
{
  if (has_ahead_)
    return true;
  while (std::getline(in_, ahead_))
  {
    ++read_;
    if (ahead_.size() > longest_line)
      throw std::invalid_argument(
          path_ + ":" + std::to_string(read_) + ": the line has " + std::to_string(ahead_.size()) + " characters, " +
          std::to_string(longest_line) +
          " are read at most; this is not an Abaqus input file, or its line breaks are missing.");
    if (ahead_.find('\0') != std::string::npos)
      throw std::invalid_argument(path_ + ":" + std::to_string(read_) +
                                  ": the line contains bytes that are not text; the file is damaged, or saved as "
                                  "UTF-16: save it as plain text (ASCII or UTF-8).");
    ahead_     = trimmed(ahead_);
    has_ahead_ = !ahead_.empty() && ahead_.compare(0, 2, "**") != 0;
    if (has_ahead_)
      return true;
  }
  return false;
}

bool InpLines::next()
{
  if (!take())
    return false;
  text_      = std::move(ahead_);
  number_    = read_;
  has_ahead_ = false;
  while (is_keyword() && text_.back() == ',' && text_.size() < longest_line && take() &&
         std::isalpha(static_cast<unsigned char>(ahead_[0])))
  {
    text_ += ahead_;
    has_ahead_ = false;
  }
  return true;
}

InpKeyword InpLines::keyword() const
{
  InpKeyword                     keyword;
  const std::vector<std::string> fields = fields_of(text_.substr(1));
  keyword.name                          = fields.empty() ? "" : in_capitals(fields[0]);
  for (std::size_t i = 1; i < fields.size(); ++i)
  {
    const auto equals = fields[i].find('=');
    keyword.parameters[in_capitals(trimmed(fields[i].substr(0, equals)))] =
        equals == std::string::npos ? "" : unquoted(trimmed(fields[i].substr(equals + 1)));
  }
  return keyword;
}

std::vector<std::string> InpLines::fields() const
{
  return fields_of(text_);
}

std::string input_of(const InpKeyword &keyword, const std::string &file)
{
  for (const char *name : {"INCLUDE", "NODE", "ELEMENT", "NSET", "ELSET", "SURFACE"})
    if (keyword.name == name && !keyword["INPUT"].empty())
      return (std::filesystem::path(file).parent_path() / keyword["INPUT"]).lexically_normal().string();
  return "";
}

} // namespace gestell::fem
