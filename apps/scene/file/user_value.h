#pragma once

#include "mechanism/functions/user_function.h"

#include <memory>
#include <string>

namespace gestell::apps
{

/// A function of the calling program (Python, C++) as the value of a scene key, which no file can hold.
struct UserValue
{
  std::string                                  mark;     ///< for messages and files: "<function press.blanking>"
  std::shared_ptr<const mechanism::UserLaw>    law{};    ///< of an element, or null
  std::shared_ptr<const mechanism::UserSignal> signal{}; ///< or null
  std::shared_ptr<void>                        origin{}; ///< the object of the calling program
};

/// The error for a text that is the mark of such an entry, as files have it; empty: it is none.
inline std::string lost_function(const std::string &text)
{
  if (text.rfind("<function ", 0) != 0)
    return {};
  return "is " + text +
         ", a function of the program that set it, which no file can hold; set it again in that program, "
         "or give a formula or another type of element";
}

} // namespace gestell::apps
