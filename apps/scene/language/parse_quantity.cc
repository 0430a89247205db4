#include "apps/scene/language/parse_quantity.h"

namespace gestell::apps
{

Quantity parse_quantity(const std::string &text, const NameLookup &parameters, const std::vector<std::string> &names,
                        const Kind *kind)
{
  const Expression e = parse_expression(text, {}, parameters, names, kind);
  return {e.formula.constant(), e.dimension, e.checked, e.counts};
}

bool is_reserved_name(const std::string &name)
{
  return name == "pi" || is_function(name);
}

} // namespace gestell::apps
