#pragma once

#include "coupling/integration/step/implicit_step.h"

#include <map>
#include <memory>
#include <string>
#include <variant>

namespace gestell::coupling
{

class SharedModes;

/// A parameter of a single method: a number, or one of its choices.
using MethodValue = std::variant<double, std::string>;

/// A method of integration by its name in integration_methods(), with all its parameters.
struct MethodOptions
{
  std::string   method       = "bdf";
  int           order        = 2;  ///< for methods with an order, see IntegrationMethod::takes_order()
  double        step         = 0.; ///< [s]; fixed, or the largest one if a tolerance is given
  double        tolerance    = 0.; ///< of the local error, relative to the scales of the motion; 0: fixed step
  int           max_halvings = 10; ///< of the step if Newton fails
  NewtonOptions newton{};

  /// Parameters of IntegrationMethod::parameters(); missing ones have their default, those of other methods are
  /// ignored.
  std::map<std::string, MethodValue> own{};

  /// Modes of the base system, shared between systems with the same matrices by methods with modes; null: not shared.
  std::shared_ptr<SharedModes> modes{};

  void set(const std::string &parameter, double value) { own[parameter] = value; }
  void set(const std::string &parameter, const std::string &choice) { own[parameter] = choice; }

  /// The same with one more parameter.
  MethodOptions with(const std::string &parameter, const MethodValue &value) const
  {
    MethodOptions more  = *this;
    more.own[parameter] = value;
    return more;
  }
};

/// A method by its name, with defaults otherwise.
inline MethodOptions options_of(const std::string &method, int order = 2)
{
  MethodOptions options;
  options.method = method;
  options.order  = order;
  return options;
}

/// Whether the error of steps is controlled, instead of a fixed length.
inline bool controlled(const MethodOptions &options)
{
  return options.tolerance > 0.;
}

} // namespace gestell::coupling
