#include "apps/study/file/variable_request.h"

#include "coupling/frame/number_in_file.h"
#include "fem/values/nearest_name.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace gestell::apps
{
namespace
{

using ValueType = SceneNode::Type;

/// A number and the unit behind it.
struct NumberWithUnit
{
  bool        is_number = false;
  double      value     = 0.;
  std::string unit{};
};

NumberWithUnit number_with_unit(const SceneNode &value)
{
  if (value.type == ValueType::integer || value.type == ValueType::real)
    return {true, value.number, ""};
  if (value.type != ValueType::text)
    return {};
  NumberWithUnit    number;
  const char *const end = coupling::read_number(value.text.c_str(), number.value);
  number.is_number      = end != value.text.c_str();
  number.unit           = end;
  number.unit.erase(0, std::min(number.unit.find_first_not_of(' '), number.unit.size()));
  return number;
}

} // namespace

bool starts_with_number(const SceneNode &value)
{
  return number_with_unit(value).is_number;
}

double in_unit(const SceneNode &value, StudyVariable &variable, const std::string &key)
{
  const NumberWithUnit number = number_with_unit(value);
  if (!number.is_number || !std::isfinite(number.value))
    value.place.fail("variables." + variable.name + "." + key +
                     ": needs a number, with its unit if it has one, such "
                     "as \"900 kN/mm\", got " +
                     described(value));
  if (variable.unit.empty())
    variable.unit = number.unit;
  if (!number.unit.empty() && number.unit != variable.unit)
    value.place.fail("variables." + variable.name + "." + key + ": is in " + number.unit + ", other values in " +
                     variable.unit + "; give all values of a variable in one unit");
  return number.value;
}

std::string VariableRequest::file(double level) const
{
  const auto nearer = [&](const auto &a, const auto &b)
  { return std::abs(a.first - level) < std::abs(b.first - level); };
  return files.empty() ? "" : std::min_element(files.begin(), files.end(), nearer)->second;
}

double VariableRequest::level(const SceneNode &value) const
{
  const std::vector<std::string> &words = variable.words;
  if (words.empty())
  {
    StudyVariable copy  = variable;
    const double  level = in_unit(value, copy, "value");
    if (!files.empty() && std::find(variable.levels.begin(), variable.levels.end(), level) == variable.levels.end())
      value.place.fail("variable " + variable.name + ": no file has the value " + variable.text(level) +
                       "; add it to 'levels', or give one of the values there");
    return level;
  }
  const std::string word  = value.type == ValueType::boolean ? (value.boolean ? "true" : "false") : value.text;
  const auto        found = std::find(words.begin(), words.end(), word);
  if (found == words.end())
    value.place.fail("variable " + variable.name + ": there is no level '" + word + "'" + suggestion(word, words));
  return double(found - words.begin());
}

} // namespace gestell::apps
