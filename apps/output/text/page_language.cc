#include "apps/output/text/page_language.h"

#include "apps/output/text/svg.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>

extern "C" const char gestell_german_begin[], gestell_german_end[];

namespace gestell::apps
{
namespace
{

bool german = false;

struct Dictionary
{
  std::map<std::string, std::string>                            texts;
  std::vector<std::pair<std::vector<std::string>, std::string>> patterns; ///< the parts about the stars
};

std::vector<std::string> about_stars(const std::string &pattern)
{
  std::vector<std::string> parts(1);
  for (const char letter : pattern)
    if (letter == '*')
      parts.emplace_back();
    else
      parts.back() += letter;
  return parts;
}

/// The lines "English<tab>German" of german.tsv.
Dictionary read_dictionary()
{
  Dictionary         read;
  std::istringstream lines(std::string(gestell_german_begin, gestell_german_end));
  for (std::string line; std::getline(lines, line);)
  {
    const std::size_t tab = line.find('\t');
    if (tab == std::string::npos)
      continue;
    const std::string english = escape_xml(line.substr(0, tab)), other = escape_xml(line.substr(tab + 1));
    if (english.find('*') != std::string::npos)
      read.patterns.emplace_back(about_stars(english), other);
    else
      read.texts[english] = other;
  }
  return read;
}

/// The texts at the stars, each as short as possible, the last up to the end; none if the text does not fit.
std::vector<std::string> kept_by(const std::vector<std::string> &parts, const std::string &text)
{
  if (text.compare(0, parts[0].size(), parts[0]) != 0)
    return {};
  std::vector<std::string> kept;
  std::size_t              at = parts[0].size();
  for (std::size_t i = 1; i < parts.size(); ++i)
  {
    const bool        last = i + 1 == parts.size();
    const std::size_t end =
        last && text.size() >= at + parts[i].size() ? text.size() - parts[i].size() : text.find(parts[i], at);
    if (end == std::string::npos || end == at || text.compare(end, parts[i].size(), parts[i]) != 0)
      return {};
    kept.push_back(text.substr(at, end - at));
    at = end + parts[i].size();
  }
  return kept;
}

/// By its own line before a pattern.
std::optional<std::string> of_whole(const Dictionary &words, const std::string &text)
{
  if (const auto found = words.texts.find(text); found != words.texts.end())
    return found->second;
  for (const auto &[parts, other] : words.patterns)
    if (const auto kept = kept_by(parts, text); !kept.empty())
    {
      const std::vector<std::string> around     = about_stars(other);
      std::string                    translated = around[0];
      for (std::size_t i = 1; i < around.size(); ++i)
        translated += kept.at(i - 1) + around[i];
      return translated;
    }
  return std::nullopt;
}

std::string in_german(const std::string &text)
{
  static const Dictionary words    = read_dictionary();
  const bool              has_unit = !text.empty() && text.back() == ']';
  const std::size_t       unit     = has_unit ? std::min(text.rfind(" ["), text.size()) : text.size();
  const std::string       name     = text.substr(0, unit);
  return of_whole(words, name).value_or(name) + text.substr(unit);
}

/// Replaces the texts that begin after `begin` and end before `end`, in a part of the page.
void translate_members(std::string &json)
{
  for (const std::string begin : {"\"title\":\"", "\"note\":\"", "\"x_label\":\"", "\"y_label\":\""})
    for (std::size_t at = json.find(begin); at != std::string::npos; at = json.find(begin, at))
    {
      at += begin.size();
      const std::size_t end   = json.find('"', at); // a text with quotation marks stays
      const std::string other = in_german(json.substr(at, end - at));
      json.replace(at, end - at, other);
      at += other.size();
    }
}

} // namespace

const std::vector<std::string> &page_languages()
{
  static const std::vector<std::string> codes = {"en", "de"};
  return codes;
}

void choose_page_language(const std::string &code)
{
  const auto &codes = page_languages();
  if (std::find(codes.begin(), codes.end(), code) == codes.end())
    throw std::invalid_argument("language of pages: \"" + code + "\" is neither \"en\" nor \"de\"");
  german = code == "de";
}

std::string in_page_language(std::string page)
{
  if (!german)
    return page;
  static const std::set<std::string> elements = {"h2", "h3",   "th",     "figcaption", "summary",
                                                 "a",  "span", "strong", "text",       "title"};
  std::string                        translated;
  for (std::size_t at = 0; at < page.size();)
  {
    const std::size_t open = std::min(page.find('<', at), page.size()), close = page.find('>', open);
    if (close == std::string::npos)
      return translated + page.substr(at);
    const std::string tag = page.substr(open, close - open), name = tag.substr(1, tag.find_first_of(" >/", 1) - 1);
    translated += page.substr(at, close + 1 - at);
    at = close + 1;
    if (name == "script" || name == "style")
    {
      const std::size_t end     = std::min(page.find("</" + name, at), page.size());
      std::string       content = page.substr(at, end - at);
      if (tag.find("application/json") != std::string::npos)
        translate_members(content);
      translated += content;
      at = end;
    }
    else if (elements.count(name))
    {
      const std::size_t end = std::min(page.find('<', at), page.size());
      translated += in_german(page.substr(at, end - at));
      at = end;
    }
  }
  return translated;
}

} // namespace gestell::apps
