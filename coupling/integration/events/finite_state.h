#pragma once

#include "coupling/integration/system/second_order_system.h"

#include <string>

namespace gestell::coupling
{

/// Whether motion and forces of the measures are numbers: by one sum, which any that is none spoils.
bool is_finite(const LocalState &state);

/// Which of them is none, for messages.
std::string no_number_words(const SecondOrderSystem &system, const LocalState &state);

} // namespace gestell::coupling
