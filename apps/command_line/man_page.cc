#include "apps/command_line/man_page.h"

#include "apps/command_line/spelled_option.h"
#include "apps/version.h"

namespace gestell::apps
{
namespace
{

/// A line that troff takes as text.
std::string plain(const std::string &text)
{
  std::string line = text.empty() || (text.front() != '.' && text.front() != '\'') ? "" : "\\&";
  for (const char c : text)
    if (c == '\\')
      line += "\\e";
    else if (c == '-')
      line += "\\-";
    else if (c == '\n')
      line += "\n.br\n";
    else
      line += c;
  return line;
}

std::string option_entry(const SpelledOption &option)
{
  std::string words;
  for (const std::string &word : option.words)
    words += (words.empty() ? "" : ", ") + std::string("\\fB") + plain(word) + "\\fR";
  if (!option.value.empty())
    words += (words.empty() ? "" : " ") + std::string("\\fI") + plain(option.value) + "\\fR";
  return ".TP\n" + words + "\n" + plain(option.description) + "\n";
}

std::string synopsis(const Command &command)
{
  const std::string input  = command.input == CommandInput::none            ? ""
                             : command.input == CommandInput::cad           ? " CAD"
                             : command.input == CommandInput::study         ? " STUDY"
                             : command.input == CommandInput::scene_or_none ? " [SCENE]"
                                                                            : " SCENE";
  std::string       inputs = input;
  for (const CommandOption &option : command.options)
    if (option.name.front() != '-')
      inputs += " [" + option.name + "]";
  return "\\fBgestell " + plain(command.name) + "\\fR" + inputs + " [OPTIONS]";
}

std::string command_section(const CLI::App &program, const Command &command)
{
  std::string text = ".SS " + synopsis(command) + "\n" + plain(command.does) + ".\n";
  for (const CLI::Option *option : program.get_subcommand(command.name)->get_options())
    if (option->get_lnames() != std::vector<std::string>{"help"})
      text += option_entry(spelled(*option));
  text += ".PP\nExamples:\n.EX\n";
  for (const std::string &example : command.examples)
    text += plain("  " + example) + "\n";
  return text + ".EE\n";
}

const char *const rest = R"(.SH EXIT STATUS
.TP
0
done
.TP
2
wrong input or usage
.TP
3
the computation failed; results up to that point are saved
.TP
130
interrupted; results up to that point are saved
.SH ENVIRONMENT
.TP
\fBGESTELL_CACHE\fR
folder of reduced frames (default: gestell in \fBXDG_CACHE_HOME\fR, or in ~/.cache)
.TP
\fBGESTELL_APART\fR
"1": as the option --apart, each process of mpirun or srun computes its own case
.TP
\fBGESTELL_KERNELS\fR
"portable": triangular solves without the vector instructions of this processor
.SH FILES
.TP
.I SCENE
a machine in its frame, a TOML file; \fBgestell new\fR writes one, \fBgestell help\fR explains its keys
.TP
.I results/NAME/report.html
report with histories, peaks, modes and pictures
.TP
.I results/NAME/summary.json
results as data; history.csv contains the signals over time, motion.pvd the motion for ParaView
)";

} // namespace

std::string man_page(const CLI::App &program, const std::vector<Command> &all)
{
  std::string text =
      std::string(".TH GESTELL 1 \"\" \"gestell ") + version +
      "\" \"User Commands\"\n.SH NAME\ngestell \\- vibrations of a machine together with its frame\n.SH SYNOPSIS\n";
  for (const Command &command : all)
    text += synopsis(command) + "\n.br\n";
  text += ".SH DESCRIPTION\n" + plain(program.get_description()) + "\n.SH COMMANDS\n";
  for (const Command &command : all)
    text += command_section(program, command);
  return text + rest;
}

} // namespace gestell::apps
