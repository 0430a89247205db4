#pragma once

#include "mechanism/local_motion.h"
#include "mechanism/switch_command.h"

#include <string>
#include <vector>

namespace gestell::mechanism
{

/// Facet of an element that accepts commands of switches.
class Commands
{
public:
  /// Names of the commands it accepts.
  virtual std::vector<std::string> command_names() const = 0;
  /// @throws std::invalid_argument if the values of one of these commands are invalid
  virtual void check_order(const SwitchCommand &) const {}
  /// Executes a command at the current motion; false: the element does not accept it.
  virtual bool command(const SwitchCommand &order, const LocalMotion &motion, double *history) const = 0;

protected:
  ~Commands() = default;
};

} // namespace gestell::mechanism
