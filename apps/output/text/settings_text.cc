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
    text << "step control with tolerance " << method.tolerance;
    if (method.step > 0.)
      text << ", at most " << method.step << " s";
  }
  else
    text << "fixed step " << method.step << " s";
  text << ", from " << run.begin << " s to " << run.end << " s; "
       << (run.events ? "events located, with a restart at each" : "events detected after the step");
  return text.str();
}

} // namespace gestell::apps
