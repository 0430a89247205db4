#include "tests/support/scaled_scene.h"

#include "apps/scene/language/parse_quantity.h"

#include <cctype>
#include <filesystem>
#include <fstream>
#include <optional>
#include <regex>
#include <sstream>
#include <stdexcept>

namespace gestell::test
{
namespace
{

/// Of metre, kilogram, second; nothing: that is no unit.
std::optional<apps::Dimension> dimension_of(const std::string &unit)
{
  try
  {
    return apps::parse_quantity("1 " + unit, [](const std::string &) { return std::optional<apps::Quantity>(); })
        .dimension;
  }
  catch (const std::invalid_argument &)
  {
    return {};
  }
}

/// "*scale_of_length^1*scale_of_time^-2"
std::string powers(const apps::Dimension &dimension)
{
  std::ostringstream text;
  for (std::size_t i = 0; i < scales.size(); ++i)
    if (dimension[i] != 0.)
      text << '*' << scales[i] << '^' << dimension[i];
  return text.str();
}

bool goes_on(char c)
{
  return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '^' || c == '(';
}

/// The longest unit that a text begins with; "": none.
std::string unit_at_begin(const std::string &text)
{
  for (std::size_t n = text.size(); n > 0; --n)
  {
    const std::string unit = text.substr(0, n);
    const bool        ends = (n == text.size() || !goes_on(text[n])) && unit.back() != ' ' &&
                      unit.find_first_of("*+") == std::string::npos && unit.find(" -") == std::string::npos;
    if (ends && dimension_of(unit))
      return unit;
  }
  return "";
}

} // namespace

std::string scaled_expression(const std::string &text)
{
  static const std::regex operand(R"((\)|\d+\.?\d*(?:[eE][+-]?\d+)?)\s*(?=[A-Za-z1%\xC2-\xCF]|/s\b))");
  std::string             made;
  std::size_t             at = 0;
  for (std::smatch found; at < text.size();)
  {
    const std::string rest = text.substr(at);
    if (!std::regex_search(rest, found, operand))
      break;
    const std::size_t begin = std::size_t(found.position()), end = begin + std::size_t(found.length());
    const char        before = begin > 0 ? rest[begin - 1] : (at > 0 ? text[at - 1] : ' ');
    const bool        inside = found[1] != ")" && (std::isalnum(static_cast<unsigned char>(before)) || before == '_');
    const std::string unit   = inside ? "" : unit_at_begin(rest.substr(end));
    made += rest.substr(0, begin);
    at += end + unit.size();
    const std::string own = rest.substr(begin, end - begin) + unit,
                      by  = unit.empty() ? "" : powers(*dimension_of(unit));
    made += by.empty() ? own : found[1] == ")" ? own + by : "((" + own + ")" + by + ")";
  }
  return made + text.substr(at);
}

std::array<double, 3> exponents(const std::string &unit)
{
  if (unit.empty() || unit == "1")
    return {};
  const auto found = dimension_of(unit);
  if (!found)
    throw std::invalid_argument("no unit: " + unit);
  return *found;
}

std::string scaled_scene(const std::string &toml)
{
  std::istringstream lines(toml);
  std::ostringstream made;
  bool               added = false;
  for (std::string line; std::getline(lines, line); made << '\n')
  {
    static const std::regex header(R"(^\s*\[\[?[A-Za-z_].*)");
    if (std::regex_match(line, header))
    {
      made << line;
      if (line.rfind("[parameters]", 0) == 0)
      {
        for (const char *scale : scales)
          made << '\n' << scale << " = \"100 %\"";
        added = true;
      }
      continue;
    }
    bool        quoted = false;
    std::string inside;
    for (const char c : line)
    {
      if (c == '#' && !quoted)
        break;
      if (c == '"')
      {
        if (quoted)
          made << '"' << scaled_expression(inside) << '"';
        quoted = !quoted;
        inside.clear();
      }
      else if (quoted)
        inside += c;
      else
        made << c;
    }
  }
  if (!added)
  {
    made << "[parameters]\n";
    for (const char *scale : scales)
      made << scale << " = \"100 %\"\n";
  }
  return made.str();
}

std::string write_scaled_scene(const std::string &name, const std::string &folder)
{
  std::ifstream      file(std::string(GESTELL_SOURCE_DIR "/apps/scenes/") + name);
  std::ostringstream text;
  text << file.rdbuf();
  const std::regex extends("extends\\s*=\\s*\"([^\"]*)\"");
  std::string      own = text.str();
  if (std::smatch found; std::regex_search(own, found, extends))
    write_scaled_scene(found[1], folder);
  const std::string path = (std::filesystem::path(folder) / name).string();
  std::ofstream(path) << scaled_scene(own);
  return path;
}

} // namespace gestell::test
