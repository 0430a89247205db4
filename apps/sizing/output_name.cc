#include "apps/sizing/output_name.h"

#include "fem/values/nearest_name.h"

#include <algorithm>
#include <stdexcept>

namespace gestell::apps
{

namespace
{

const std::vector<std::string> kinds  = {"min", "max", "t_min", "t_max", "final", "range"};
const std::vector<std::string> counts = {"events", "work", "steps", "model", "newton", "factorisations"};

bool among(const std::vector<std::string> &names, const std::string &name)
{
  return std::find(names.begin(), names.end(), name) != names.end();
}

[[noreturn]] void refuse(const std::string &given, const std::string &reason)
{
  throw std::invalid_argument("--outputs: '" + given + "' " + reason);
}

OutputName mode_named(const std::string &given, const std::string &number, int modes)
{
  OutputName output;
  output.text = given;
  if (number.empty() || number.find_first_not_of("0123456789") != std::string::npos || number.size() > 6)
    refuse(given, "needs the number of a mode, such as modes.1");
  output.mode = std::stoi(number);
  if (output.mode < 1 || output.mode > modes)
    refuse(given, "is not among the " + std::to_string(modes) + " listed modes; raise modes.number");
  return output;
}

} // namespace

OutputName output_named(const std::string &given, const std::vector<std::string> &signals, int modes)
{
  const std::size_t dot    = given.rfind('.');
  const std::string before = given.substr(0, dot), after = dot == std::string::npos ? "" : given.substr(dot + 1);
  if (before == "modes" && !among(signals, before))
    return mode_named(given, after, modes);
  if (among(signals, before) && among(kinds, after))
    return {given, before, after, 0};
  if (among(counts, given) || among(counts, given.substr(0, given.find('.'))))
    refuse(given, "is a count, which has no error; name a number of a signal, such as " +
                      (signals.empty() ? "F.max" : signals.front() + ".max"));
  if (among(signals, given))
    refuse(given, "is a signal; name one of its numbers: " + given + ".max, .min, .t_max, .t_min, .range or .final");
  if (among(signals, before))
    refuse(given, "requests '" + after +
                      "' of a signal, which does not exist; valid: max, min, t_max, t_min, range and final");
  const std::string nearest = nearest_name(before, signals);
  refuse(given,
         "is not an output of this scene" +
             (nearest.empty() ? "" : "; did you mean " + nearest + "." + (among(kinds, after) ? after : "max") + "?"));
}

std::vector<OutputName> outputs_named(const std::string &list, const std::vector<std::string> &signals, int modes)
{
  std::vector<OutputName> outputs;
  if (list.empty())
    for (const std::string &signal : signals)
      for (const char *kind : {"max", "min"})
        outputs.push_back(output_named(signal + "." + kind, signals, modes));
  for (std::size_t at = 0; at < list.size();)
  {
    const std::size_t end = std::min(list.find(',', at), list.size());
    std::string       one = list.substr(at, end - at);
    one.erase(0, one.find_first_not_of(' '));
    one.erase(one.find_last_not_of(' ') + 1);
    outputs.push_back(output_named(one, signals, modes));
    at = end + 1;
  }
  if (outputs.empty())
    throw std::invalid_argument("--outputs: this scene has no signals; name some in [output], or a mode: modes.1");
  return outputs;
}

std::vector<std::string> signals_of(const std::vector<OutputName> &outputs)
{
  std::vector<std::string> names;
  for (const OutputName &output : outputs)
    names.push_back(output.signal);
  return names;
}

double value_of(const OutputName &output, const coupling::SignalSummary &signal)
{
  return output.kind == "min"     ? signal.min
         : output.kind == "max"   ? signal.max
         : output.kind == "t_min" ? signal.t_min
         : output.kind == "t_max" ? signal.t_max
         : output.kind == "range" ? signal.max - signal.min
                                  : signal.final;
}

std::string unit_of(const OutputName &output, const coupling::SignalSummary &signal)
{
  return output.kind.rfind("t_", 0) == 0 ? "s" : signal.unit;
}

double decided_at(const OutputName &output, const coupling::SignalSummary &signal, double end)
{
  return output.kind == "min" || output.kind == "t_min"   ? signal.t_min
         : output.kind == "max" || output.kind == "t_max" ? signal.t_max
         : output.kind == "range"                         ? std::max(signal.t_min, signal.t_max)
                                                          : end;
}

} // namespace gestell::apps
