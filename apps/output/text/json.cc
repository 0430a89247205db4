#include "apps/output/text/json.h"

namespace gestell::apps
{

std::string json_text(const Json &value)
{
  return value.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

} // namespace gestell::apps
