#include "apps/study/file/unit_quantity.h"

#include "apps/scene/language/parse_quantity.h"

#include <map>
#include <mutex>
#include <stdexcept>

namespace gestell::apps
{
namespace
{

Quantity one_of_unit(const std::string &unit)
{
  Quantity one{1., {}, true, Counts::nothing};
  try
  {
    if (!unit.empty())
      one = parse_quantity("1 " + unit, [](const std::string &) { return std::optional<Quantity>(); });
  }
  catch (const std::invalid_argument &)
  {
    one.checked = false;
  }
  return one;
}

} // namespace

Quantity quantity_in_unit(double value, const std::string &unit)
{
  static std::mutex                      mutex;
  static std::map<std::string, Quantity> units;
  const std::lock_guard<std::mutex>      alone(mutex);
  const auto                             known = units.find(unit);
  Quantity quantity = known != units.end() ? known->second : units.emplace(unit, one_of_unit(unit)).first->second;
  quantity.value *= value;
  return quantity;
}

} // namespace gestell::apps
