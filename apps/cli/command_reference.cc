#include "apps/cli/command_reference.h"

#include <algorithm>

namespace gestell::apps
{
namespace
{

/// A cell of a table; vertical bars would end it.
std::string cell_text(std::string text)
{
  for (auto at = text.find('|'); at != std::string::npos; at = text.find('|', at + 2))
    text.insert(at, "\\");
  return text;
}

std::string input_word(const Command &command)
{
  switch (command.input)
  {
  case CommandInput::scene:
    return " SCENE";
  case CommandInput::scene_or_none:
    return " [SCENE]";
  case CommandInput::cad:
    return " CAD";
  case CommandInput::study:
    return " STUDY";
  case CommandInput::none:
    break;
  }
  return "";
}

/// "`-o`, `--output`", "`--peers`, `--no-peers`".
std::string option_names(const std::string &option)
{
  std::string text = "`";
  for (const char letter : option)
    text += letter == ',' ? "`, `" : letter == '!' ? "" : std::string(1, letter);
  return text + "`";
}

std::string command_section(const Command &command)
{
  std::string text = "### " + command.name + "\n\n`gestell " + command.name + input_word(command);
  for (const CommandOption &option : command.options)
    if (option.name.front() != '-')
      text += " [" + option.name + "]";
  text += " [OPTIONS]`: " + command.does + ".\n\n";
  if (!command.options.empty())
    text += "| Option | Description |\n|---|---|\n";
  for (const CommandOption &option : command.options)
    text += "| " + option_names(option.name) + " | " + cell_text(option.does) +
            (option.needs.empty() ? "" : "; with `" + option.needs + "`") + " |\n";
  text += std::string(command.options.empty() ? "" : "\n") + "Examples: ";
  for (const std::string &example : command.examples)
    text += (&example == &command.examples.front() ? "`" : ", `") + example + "`";
  return text + "\n\n";
}

} // namespace

std::string command_reference(const std::vector<Command> &all)
{
  std::vector<Command> sorted = all;
  std::sort(sorted.begin(), sorted.end(), [](const Command &a, const Command &b) { return a.name < b.name; });
  std::string text;
  for (const Command &command : sorted)
    text += command_section(command);
  return text;
}

} // namespace gestell::apps
