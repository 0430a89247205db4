#include "apps/cli/command.h"

namespace gestell::apps
{

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

} // namespace gestell::apps
