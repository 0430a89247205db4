#include "coupling/sensitivity/meeting_events.h"

#include <cmath>
#include <sstream>

namespace gestell::coupling
{

std::vector<std::string> meeting_events(const std::vector<OutputDerivatives> &outputs,
                                        const std::vector<ParameterTwins> &twins, double near)
{
  std::vector<std::string>               sentences;
  std::vector<const OutputDerivatives *> events;
  for (const OutputDerivatives &output : outputs)
    if (output.output.compare(0, 7, "events.") == 0)
      events.push_back(&output);
  for (int k = 0; k < int(twins.size()); ++k)
  {
    const double value    = std::abs(twins[std::size_t(k)].value);
    double       smallest = one_percent;
    std::string  which;
    for (std::size_t i = 1; i < events.size(); ++i)
    {
      const double gap   = events[i]->value - events[i - 1]->value;
      const double share = gap / (std::abs(events[i]->derivative[k] - events[i - 1]->derivative[k]) * value);
      if (gap > near && share < smallest)
      {
        smallest = share;
        which    = events[i - 1]->note + " and " + events[i]->note;
      }
    }
    if (which.empty())
      continue;
    std::ostringstream text;
    text.precision(2);
    text << "a change of " << twins[std::size_t(k)].key << " by " << 100. * smallest << " % makes " << which
         << " coincide; its derivatives are valid for smaller changes";
    sentences.push_back(text.str());
  }
  return sentences;
}

} // namespace gestell::coupling
