#include "apps/session/option_value.h"

#include "apps/scene/language/parse_quantity.h"
#include "coupling/frame/number_in_file.h"

#include <cstdlib>
#include <stdexcept>

namespace gestell::apps
{

double option_value(const std::string &option, const std::string &text, const Kind &kind)
{
  try
  {
    const Quantity quantity = parse_quantity(
        text, [](const std::string &) { return std::nullopt; }, {}, &kind);
    double plain = 0.;
    if (!text.empty() && *coupling::read_number(text.c_str(), plain) == '\0') // plain numbers are SI
      return quantity.value;
    return value_as(quantity, kind, text);
  }
  catch (const std::invalid_argument &error)
  {
    throw std::invalid_argument(option + ": " + error.what());
  }
}

} // namespace gestell::apps
