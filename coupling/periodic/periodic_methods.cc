#include "coupling/periodic/periodic_methods.h"

#include "coupling/periodic/averaging/averaging.h"
#include "coupling/periodic/collocation/collocation_method.h"
#include "coupling/periodic/harmonic/harmonic_balance_method.h"
#include "coupling/periodic/minimising.h"
#include "coupling/periodic/settling.h"
#include "coupling/periodic/shooting/shooting_method.h"

#include <algorithm>
#include <stdexcept>

namespace gestell::coupling
{

const std::vector<const PeriodicMethod *> &periodic_methods()
{
  static const std::vector<const PeriodicMethod *> all = {&shooting_method(),    &harmonic_balance_method(),
                                                          &minimising_method(),  &settling_method(),
                                                          &collocation_method(), &averaging_method()};
  return all;
}

const PeriodicMethod &periodic_method(const std::string &name)
{
  std::string names;
  for (const PeriodicMethod *method : periodic_methods())
  {
    if (method->name() == name)
      return *method;
    names += (names.empty() ? "" : ", ") + method->name();
  }
  throw std::invalid_argument("there is no periodic method \"" + name + "\"; there are " + names);
}

std::vector<PeriodicOption> options_of_periodic_methods()
{
  std::vector<PeriodicOption> all;
  for (const PeriodicMethod *method : periodic_methods())
    for (const PeriodicOption &option : method->options())
      if (std::none_of(all.begin(), all.end(), [&](const PeriodicOption &known) { return known.name == option.name; }))
        all.push_back(option);
  return all;
}

} // namespace gestell::coupling
