#include "apps/analysis/command_option.h"

#include "coupling/frame/number_in_file.h"
#include "fem/values/nearest_name.h"

#include <algorithm>
#include <stdexcept>
#include <type_traits>

namespace gestell::apps
{
namespace
{

template <class T>
T value_of_text(const std::string &option, const std::string &text)
{
  if constexpr (std::is_same_v<T, std::string>)
    return text;
  else if constexpr (std::is_same_v<T, bool>)
    return !text.empty() && text != "False";
  else
  {
    double value = 0.;
    if (text.empty() || *coupling::read_number(text.c_str(), value) != '\0' || value != double(T(value)))
      throw std::invalid_argument(option + ": needs a " + (std::is_integral_v<T> ? "whole number" : "number") +
                                  ", got '" + text + "'");
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
            target->push_back(value_of_text<typename Target::value_type>(name, text));
        }
        else
          *target = value_of_text<Target>(name, texts.empty() ? "" : texts.front());
      },
      value);
}

} // namespace gestell::apps
