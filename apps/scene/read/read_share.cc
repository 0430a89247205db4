#include "apps/scene/read/read_share.h"

#include <sstream>

namespace gestell::apps
{

double read_share(const SceneTable &table, const std::string &key)
{
  const double share = table.positive(key, kind::number);
  if (share <= 1.)
    return share;
  std::ostringstream text;
  text << "needs a share of at most 1, got " << share << "; percent are written \"" << share << " %\"";
  throw table.error(key, text.str());
}

double read_share(const SceneTable &table, const std::string &key, double fallback)
{
  return table.has(key) ? read_share(table, key) : fallback;
}

} // namespace gestell::apps
