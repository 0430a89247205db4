#pragma once

#include <functional>
#include <string>
#include <vector>

namespace gestell::mechanism
{

/// Numbers of the caller.
struct Numbers
{
  const double *begin = nullptr;
  int           n     = 0;
};

/// A function of the calling program (Python, C++): n_y numbers y of arguments x and of a state s.
/// @throws std::exception with its reason, of Python the traceback
using UserFunction = std::function<void(Numbers x, Numbers s, double *y, int n_y)>;

/**
 * A force law of the calling program, F(t, u, u', s).  Arguments of its functions: x = (t, u, u'); of `at_event` x =
 * (k, t, u, u') with the number k of the event.
 */
struct UserLaw
{
  UserFunction             force;          ///< F [N, N m]
  UserFunction             derivative{};   ///< dF/du, dF/du'; none: central differences
  std::vector<double>      state{};        ///< s at the start
  std::vector<std::string> events{};       ///< names
  UserFunction             event_values{}; ///< one for each event, which occurs where its value rises through zero
  UserFunction             at_event{};     ///< s after an event; none: s stays
  UserFunction             after_step{};   ///< s after an accepted step; none: s stays
};

/// A signal of the calling program, as a function of other signals.
struct UserSignal
{
  UserFunction             value;
  std::vector<std::string> of{}; ///< paths of the other signals, its arguments
  std::string              unit{};
};

} // namespace gestell::mechanism
