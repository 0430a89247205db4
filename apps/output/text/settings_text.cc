#include "apps/output/text/settings_text.h"

#include <sstream>

namespace gestell::apps
{

std::string settings_text(const coupling::RunOptions &run)
{
  const coupling::MethodOptions &method = run.method;
  std::ostringstream             text;
  text << coupling::method_name(method) << ", ";
  if (method.tolerance > 0.)
  {
    text << "step controlled to a tolerance of " << method.tolerance;
    if (method.step > 0.)
      text << ", at most " << method.step << " s";
  }
  else
    text << "fixed step " << method.step << " s";
  text << ", from " << run.begin << " s to " << run.end << " s; "
       << (run.events ? "events located, the integration restarts at each of them"
                      : "events are stepped over and reported afterwards");
  return text.str();
}

} // namespace gestell::apps
