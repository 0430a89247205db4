#include "apps/command_line/completion.h"

#include "apps/command_line/spelled_option.h"

#include <stdexcept>

namespace gestell::apps
{
namespace
{

std::string joined(const std::vector<std::string> &words)
{
  std::string line;
  for (const std::string &word : words)
    line += (line.empty() ? "" : " ") + word;
  return line;
}

/// Endings of the files that a command takes.
std::string endings(CommandInput input)
{
  return input == CommandInput::none ? "" : input == CommandInput::cad ? "step|stp|brep|geo|msh|inp" : "toml";
}

std::vector<std::string> option_words(const CLI::App &command)
{
  std::vector<std::string> words;
  for (const CLI::Option *option : command.get_options())
    for (const std::string &word : spelled(*option).words)
      words.push_back(word);
  return words;
}

/// Words for the inputs of a command, of those that the shell takes as one.
std::vector<std::string> proposed(const Command &command)
{
  std::vector<std::string> words;
  for (const CommandOption &option : command.options)
    for (const std::string &word : option.proposals)
      if (word.find(' ') == std::string::npos)
        words.push_back(word);
  return words;
}

const CLI::App &app_of(const CLI::App &program, const Command &command)
{
  return *program.get_subcommand(command.name);
}

/// Case branches "run --method) words=...;;": values of the option before the cursor.
std::string bash_choices(const std::vector<Command> &all)
{
  std::string branches;
  for (const Command &command : all)
    for (const CommandOption &option : command.options)
      if (!option.choices.empty())
        branches += "    '" + command.name + " " + option.name + "') words='" + joined(option.choices) + "' ;;\n";
  return branches;
}

std::string bash_commands(const CLI::App &program, const std::vector<Command> &all)
{
  std::string branches;
  for (const Command &command : all)
  {
    branches += "    " + command.name + ") options='" + joined(option_words(app_of(program, command))) + "'";
    if (!endings(command.input).empty())
      branches += " files='" + endings(command.input) + "'";
    if (!proposed(command).empty())
      branches += " words='" + joined(proposed(command)) + "'";
    branches += " ;;\n";
  }
  return branches;
}

std::string bash(const CLI::App &program, const std::vector<Command> &all)
{
  std::vector<std::string> names;
  for (const Command &command : all)
    names.push_back(command.name);
  return R"sh(# bash completion for gestell
_gestell()
{
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} command=${COMP_WORDS[1]} options= files= words=
  COMPREPLY=()
  if ((COMP_CWORD == 1)); then
    COMPREPLY=($(compgen -W ')sh" +
         joined(names) + joined(option_words(program)).insert(0, " ") + R"sh(' -- "$word"))
    return
  fi
  case "$command $before" in
)sh" + bash_choices(all) +
         R"sh(    *' -o'|*' --output') COMPREPLY=($(compgen -d -- "$word")); return ;;
  esac
  if [[ $words ]]; then
    COMPREPLY=($(compgen -W "$words" -- "$word"))
    return
  fi
  case $command in
)sh" + bash_commands(program, all) +
         R"sh(  esac
  if [[ $word == -* ]]; then
    COMPREPLY=($(compgen -W "$options" -- "$word"))
  elif [[ $words ]]; then
    COMPREPLY=($(compgen -W "$words" -- "$word"))
  elif [[ $files ]]; then
    local extglob=$(shopt -p extglob)
    shopt -s extglob
    compopt -o filenames 2>/dev/null
    COMPREPLY=($(compgen -f -X "!*.@($files)" -- "$word") $(compgen -d -- "$word"))
    $extglob
  fi
}
complete -F _gestell gestell
)sh";
}

/// Within a pair of single quotes, in the description of an argument.
std::string zsh_text(const std::string &text)
{
  std::string quoted;
  for (const char c : text)
    if (c == '\'')
      quoted += "'\\''";
    else if (c == '[' || c == ']' || c == ':' || c == '\\')
      quoted += std::string("\\") + c;
    else
      quoted += c;
  return quoted;
}

std::string zsh_option(const std::string &word, const SpelledOption &option, const CommandOption *own)
{
  std::string line = "'" + word + "[" + zsh_text(option.description) + "]";
  if (!option.value.empty())
    line += word == "-o" || word == "--output"        ? ":folder:_files -/"
            : own != nullptr && !own->choices.empty() ? ":value:(" + joined(own->choices) + ")"
                                                      : ":" + zsh_text(option.value) + ": ";
  return line + "'";
}

const CommandOption *option_named(const Command &command, const std::string &word)
{
  for (const CommandOption &option : command.options)
    if (option.name == word)
      return &option;
  return nullptr;
}

std::string zsh_command(const CLI::App &program, const Command &command)
{
  std::string line = "    " + command.name + ") _arguments";
  for (const CLI::Option *option : app_of(program, command).get_options())
    for (const std::string &word : spelled(*option).words)
      line += " \\\n      " + zsh_option(word, spelled(*option), option_named(command, word));
  if (!endings(command.input).empty())
    line += " \\\n      '*:file:_files -g \"*.(" + endings(command.input) + ")\"'";
  if (!proposed(command).empty())
    line += " \\\n      '*:word:(" + joined(proposed(command)) + ")'";
  return line + " ;;\n";
}

std::string zsh(const CLI::App &program, const std::vector<Command> &all)
{
  std::string names, branches;
  for (const Command &command : all)
  {
    names += "    '" + command.name + ":" + zsh_text(command.does) + "'\n";
    branches += zsh_command(program, command);
  }
  return R"sh(#compdef gestell
_gestell()
{
  local -a commands
  commands=(
)sh" + names +
         R"sh(  )
  if ((CURRENT == 2)); then
    _describe command commands
    return
  fi
  shift words
  ((CURRENT--))
  case $words[1] in
)sh" + branches +
         R"sh(  esac
}
_gestell "$@"
)sh";
}

} // namespace

std::string completion(const CLI::App &program, const std::vector<Command> &all, const std::string &shell)
{
  if (shell == "bash")
    return bash(program, all);
  if (shell == "zsh")
    return zsh(program, all);
  throw std::invalid_argument("--completion " + shell + ": there are 'bash' and 'zsh'");
}

} // namespace gestell::apps
