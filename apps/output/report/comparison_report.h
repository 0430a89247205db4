#pragma once

#include "apps/output/text/svg.h"
#include "apps/output/values/result.h"

#include <string>

namespace gestell::apps
{

/// Modes of the scene beside those of another one; adds its picture.  Empty where none were compared.
std::string compared_modes_section(const Result &result, Pictures &pictures);

} // namespace gestell::apps
