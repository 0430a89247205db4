#include "coupling/linear_base.h"

namespace gestell::coupling
{

LinearBase::~LinearBase() = default;

} // namespace gestell::coupling
