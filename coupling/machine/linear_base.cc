#include "coupling/machine/linear_base.h"

namespace gestell::coupling
{

LinearBase::~LinearBase() = default;

} // namespace gestell::coupling
