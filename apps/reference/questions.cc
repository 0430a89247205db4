#include "apps/reference/questions.h"

#include <algorithm>
#include <cctype>
#include <sstream>

namespace gestell::apps
{
namespace
{

std::string lower(std::string text)
{
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

bool contains_all(const std::string &text, const std::string &words)
{
  std::istringstream in(lower(words));
  for (std::string word; in >> word;)
    if (lower(text).find(word) == std::string::npos)
      return false;
  return true;
}

} // namespace

const std::vector<Question> &questions()
{
  static const std::vector<Question> all = {
      {"How do I begin?", "new KIND"},
      {"Is my scene right, and how was it understood?", "check SCENE"},
      {"Which face of the CAD model is which?", "mesh CAD -o DIR"},
      {"What force acts in a joint, a rod, a bearing?", "run SCENE"},
      {"What motion, torque or stress, when is it largest?", "run SCENE"},
      {"What steady state does the machine reach, is it stable?", "periodic SCENE"},
      {"At which speed is there a resonance or a jump?", "periodic SCENE --along KEY --from A --to B"},
      {"Which natural frequency, which mode shape?", "modes SCENE"},
      {"Which frequency in which position of the machine?", "modes SCENE --along COORDINATE"},
      {"Which frequency answers a vibrating force, how much?", "frf SCENE --from A --to B"},
      {"How much model do I need: mesh, modes, step?", "size SCENE --tolerance 0.01 --outputs A.max"},
      {"How exact is a force or another output?", "run SCENE --budget"},
      {"How exact is a frequency, is the mesh fine enough?", "modes SCENE --converge 0.01"},
      {"How exact is the reduced frame?", "reduce SCENE"},
      {"Which integrator, which step?", "stability SCENE"},
      {"Which method costs least for an error?", "chart SCENE"},
      {"What changes the result, by how much?", "run SCENE --sensitivities all"},
      {"What do two designs differ in?", "run SCENE --compare OTHER"},
      {"Will the frame crack, where and after how long?", "life SCENE"},
      {"Which dimension is best?", "study STUDY"},
      {"What does it look like in motion?", "show DIR"},
      {"How do I import a frame of Nastran or another program?", "help frame"},
      {"How does it run in another program, as an FMU?", "export SCENE --fmu FILE"},
      {"What does a key mean?", "help KEY"},
  };
  return all;
}

std::string question_table()
{
  std::string text = "| question | command |\n|---|---|\n";
  for (const Question &question : questions())
    text += "| " + question.asks + " | `gestell " + question.command + "` |\n";
  return text;
}

std::string question_lines(const std::string &words)
{
  std::size_t width = 0;
  for (const Question &question : questions())
    width = std::max(width, question.asks.size());
  std::string text;
  for (const Question &question : questions())
    if (contains_all(question.asks, words))
      text += "  " + question.asks + std::string(width + 2 - question.asks.size(), ' ') + "gestell " +
              question.command + "\n";
  return text;
}

} // namespace gestell::apps
