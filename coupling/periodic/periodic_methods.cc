#include "coupling/periodic/periodic_methods.h"

#include "coupling/periodic/averaging/averaging.h"
#include "coupling/periodic/collocation/collocation_branch.h"
#include "coupling/periodic/collocation/collocation_method.h"
#include "coupling/periodic/harmonic/harmonic_balance_method.h"
#include "coupling/periodic/minimising.h"
#include "coupling/periodic/settling.h"
#include "coupling/periodic/shooting/shooting_method.h"

#include <algorithm>
#include <stdexcept>

namespace gestell::coupling
{

namespace
{

using Branch = std::unique_ptr<BranchEquations>(const PeriodicSolution &, const ProblemFamily &,
                                                const PeriodicOptions &, int);

std::unique_ptr<BranchEquations> by_shooting(const PeriodicSolution &first, const ProblemFamily &family,
                                             const PeriodicOptions &options, int ratio)
{
  return shooting_branch(family, options, 2. * M_PI / first.period, ratio);
}

std::unique_ptr<BranchEquations> by_collocation(const PeriodicSolution &, const ProblemFamily &family,
                                                const PeriodicOptions &options, int ratio)
{
  return collocation_branch(family, options, ratio);
}

std::unique_ptr<BranchEquations> by_balance(const PeriodicSolution &, const ProblemFamily &family,
                                            const PeriodicOptions &options, int)
{
  return balance_branch(family, options);
}

/// A method, and the equations that follow its solutions; null: there are none.
struct Listed
{
  const PeriodicMethod &method;
  Branch               *branch;
};

const std::vector<Listed> &listed()
{
  static const std::vector<Listed> all = {
      {shooting_method(), by_shooting}, {harmonic_balance_method(), by_balance}, {minimising_method(), by_shooting},
      {settling_method(), by_shooting}, {collocation_method(), by_collocation},  {averaging_method(), nullptr}};
  return all;
}

} // namespace

const std::vector<const PeriodicMethod *> &periodic_methods()
{
  static const std::vector<const PeriodicMethod *> all = []
  {
    std::vector<const PeriodicMethod *> methods;
    for (const Listed &one : listed())
      methods.push_back(&one.method);
    return methods;
  }();
  return all;
}

std::string why_no_branch(const PeriodicMethod &method)
{
  for (const Listed &one : listed())
    if (&one.method == &method && one.branch)
      return "";
  return method.name() +
         " cannot follow a branch; use --method harmonic-balance --harmonics 1, which has the equations of " +
         "averaging without the limit of small changes";
}

std::unique_ptr<BranchEquations> branch_from(const PeriodicSolution &first, const ProblemFamily &family,
                                             const PeriodicOptions &options, int ratio)
{
  for (const Listed &one : listed())
    if (one.method.name() == first.method && one.branch)
      return one.branch(first, family, options, ratio);
  throw std::invalid_argument("no branch begins at a solution by \"" + first.method + '"');
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
