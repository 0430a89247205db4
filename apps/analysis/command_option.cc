#include "apps/analysis/command_option.h"

#include "coupling/frame/number_in_file.h"
#include "fem/values/nearest_name.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <type_traits>

namespace gestell::apps
{
namespace
{

template <class T>
T value_of_text(const CommandOption &option, const std::string &text)
{
  if constexpr (std::is_same_v<T, std::string>)
    return text;
  else if constexpr (std::is_same_v<T, bool>)
  {
    if (text == "true" || text == "True" || text == "1")
      return true;
    if (text.empty() || text == "false" || text == "False" || text == "0")
      return false;
    throw std::invalid_argument(option.name + ": needs true or false, got '" + text + "'");
  }
  else
  {
    double     value = 0.;
    const bool above = option.range == CommandOption::Range::above_zero;
    const bool reads = !text.empty() && *coupling::read_number(text.c_str(), value) == '\0';
    const bool fits  = std::isfinite(value) && (!above || value > 0.) && (option.most == 0. || value <= option.most);
    const bool whole = !std::is_integral_v<T> ||
                       (value == std::floor(value) && std::abs(value) <= double(std::numeric_limits<int>::max()));
    if (!reads || !fits || !whole)
      throw std::invalid_argument(option.name + ": needs " + (std::is_integral_v<T> ? "an integer" : "a number") +
                                  (above ? " above zero" : "") +
                                  (option.most > 0. ? ", at most " + short_text(option.most, 12) : "") + ", got '" +
                                  text + "'");
    return T(value);
  }
}

} // namespace

CommandOption CommandOption::above_zero() const
{
  CommandOption option = *this;
  option.range         = Range::above_zero;
  return option;
}

CommandOption CommandOption::at_most(double number) const
{
  CommandOption option = *this;
  option.most          = number;
  return option;
}

CommandOption CommandOption::existing_file() const
{
  CommandOption option = *this;
  option.range         = Range::existing_file;
  return option;
}

CommandOption CommandOption::one_of(const std::vector<std::string> &names) const
{
  CommandOption option = *this;
  option.choices       = names;
  return option;
}

CommandOption CommandOption::proposing(const std::vector<std::string> &words) const
{
  CommandOption option = *this;
  option.proposals     = words;
  return option;
}

CommandOption CommandOption::with(const std::string &other) const
{
  CommandOption option = *this;
  option.needs         = other;
  return option;
}

CommandOption CommandOption::of_files() const
{
  CommandOption option = *this;
  option.writes        = true;
  return option;
}

std::string CommandOption::key() const
{
  std::string key = name.substr(0, name.find(','));
  key.erase(0, key.find_first_not_of('-'));
  std::replace(key.begin(), key.end(), '-', '_');
  return key;
}

void CommandOption::set(const std::vector<std::string> &texts) const
{
  if (!choices.empty())
    for (const std::string &text : texts)
      if (std::find(choices.begin(), choices.end(), text) == choices.end())
        throw std::invalid_argument(name + " is \"" + text + "\"" + suggestion(text, choices));
  std::visit(
      [&](auto *target)
      {
        using Target = std::decay_t<decltype(*target)>;
        if constexpr (std::is_class_v<Target> && !std::is_same_v<Target, std::string>)
        {
          target->clear();
          for (const std::string &text : texts)
            target->push_back(value_of_text<typename Target::value_type>(*this, text));
        }
        else
        {
          std::string one;
          for (const std::string &text : texts)
            one += (one.empty() ? "" : ",") + text;
          *target = value_of_text<Target>(*this, one);
        }
      },
      value);
}

} // namespace gestell::apps
