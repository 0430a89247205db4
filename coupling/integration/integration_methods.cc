#include "coupling/integration/integration_methods.h"

#include "coupling/integration/bdf/bdf_method.h"
#include "coupling/integration/newmark/newmark_methods.h"
#include "coupling/integration/newmark/wilson_method.h"
#include "coupling/integration/propagation/propagation_method.h"
#include "coupling/integration/step/rounding_floors.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

namespace gestell::coupling
{

namespace
{

/// "bdf and exact"
std::string controlling_methods()
{
  std::string names;
  for (const IntegrationMethod *method : integration_methods())
    if (method->can_control_error())
      names += (names.empty() ? "" : " and ") + method->name();
  return names;
}

void check_steps(const MethodOptions &o, const std::string &label)
{
  const bool controllable = method_of(o).can_control_error();
  require_parameter(o.step >= 0. && std::isfinite(o.step), label, "step [s]", o.step, "positive");
  require_parameter(o.tolerance >= 0. && o.tolerance < 1., label, "tolerance", o.tolerance, "between 0 and 1");
  require_parameter(o.tolerance == 0. || controllable, label, "tolerance", o.tolerance,
                    "omitted, because only " + controlling_methods() + " control their step; set a step");
  require_parameter(o.tolerance == 0. || o.tolerance >= finest_tolerance, label, "tolerance", o.tolerance,
                    "1e-13 or more (below is rounding)");
  require_parameter(o.tolerance > 0. || o.step > 0., label, "step [s]", o.step,
                    "positive, unless a tolerance is given");
  require_parameter(o.newton.tolerance >= finest_tolerance && o.newton.tolerance < 1., label, "newton_tolerance",
                    o.newton.tolerance, "1e-13 or more, below 1");
}

} // namespace

const std::vector<const IntegrationMethod *> &integration_methods()
{
  static const std::vector<const IntegrationMethod *> all = {
      &bdf_method(),        &newmark_method(),           &wilson_method(),
      &hht_method(),        &generalised_alpha_method(), &central_difference_method(),
      &propagation_method()};
  return all;
}

const IntegrationMethod &integration_method(const std::string &name)
{
  static const std::map<std::string, const IntegrationMethod *> by_name = []
  {
    std::map<std::string, const IntegrationMethod *> methods;
    for (const IntegrationMethod *method : integration_methods())
      methods[method->name()] = method;
    return methods;
  }();
  if (const auto found = by_name.find(name); found != by_name.end())
    return *found->second;
  throw std::invalid_argument("there is no method of integration \"" + name + "\"");
}

const IntegrationMethod &method_of(const MethodOptions &options)
{
  return integration_method(options.method);
}

std::string method_name(const MethodOptions &options)
{
  return method_of(options).label(options);
}

namespace
{

bool known_to_some(const std::string &parameter)
{
  for (const IntegrationMethod *method : integration_methods())
    for (const MethodParameter &known : method->parameters())
      if (known.name == parameter)
        return true;
  return false;
}

/// A choice is one of those there are.
void check_choice(const std::string &method, const MethodParameter &parameter, const MethodOptions &options)
{
  const auto given = options.own.find(parameter.name);
  if (given == options.own.end())
    return;
  const std::string *choice = std::get_if<std::string>(&given->second);
  if (choice && std::count(parameter.choices.begin(), parameter.choices.end(), *choice) > 0)
    return;
  std::string all;
  for (const std::string &known : parameter.choices)
    all += (all.empty() ? "" : ", ") + known;
  throw std::invalid_argument(method + ": " + parameter.name + " is " + (choice ? "\"" + *choice + "\"" : "a number") +
                              "; it must be one of " + all);
}

} // namespace

void check_method(const MethodOptions &options)
{
  const IntegrationMethod &method = method_of(options);
  const std::string        label  = method.label(options);
  check_steps(options, label);
  for (const auto &given : options.own)
    if (!known_to_some(given.first))
      throw std::invalid_argument(label + ": no method of integration has a parameter \"" + given.first + "\"");
  for (const MethodParameter &parameter : method.parameters())
    if (!parameter.choices.empty())
      check_choice(label, parameter, options);
    else
    {
      const double value = method.number(options, parameter.name);
      require_parameter(parameter.valid(value), label, parameter.name, value, parameter.range);
    }
  method.check(options);
}

std::unique_ptr<TimeIntegrator> make_integrator(const SecondOrderSystem &system, const MethodOptions &options)
{
  check_method(options);
  return method_of(options).make(system, options);
}

} // namespace gestell::coupling
