#pragma once

#include "coupling/machine/machine.h"
#include "mechanism/switched_element.h"
#include "mechanism/transmitted_element.h"

namespace gestell::coupling
{

/// The law of this kind in an element, directly or behind measures or switches; null if it has another law.
template <typename Law>
const Law *law_of(const ElementPlacement &placement)
{
  const mechanism::Element *element = placement.element.get();
  if (const auto *transmitted = dynamic_cast<const mechanism::TransmittedElement *>(element))
    element = &transmitted->law();
  if (const auto *switched = dynamic_cast<const mechanism::SwitchedElement *>(element))
    element = &switched->law();
  return dynamic_cast<const Law *>(element);
}

} // namespace gestell::coupling
