#include "mechanism/joints/constraint_element.h"

#include "mechanism/functions/slope_jump.h"

#include <sstream>
#include <stdexcept>

namespace gestell::mechanism
{

void ConstraintElement::start(const LocalMotion &motion, double *history) const
{
  if (law_)
    law_->start(motion.t, history);
}

std::vector<Guard> ConstraintElement::guards(const double *history) const
{
  return law_ ? law_->guards(history) : std::vector<Guard>{};
}

void ConstraintElement::guard_values(const LocalMotion &motion, const double *history, double *g) const
{
  if (law_)
    law_->guard_values(motion.t, history, g);
}

void ConstraintElement::transition(int i, const LocalMotion &motion, double *history) const
{
  law_->transition(i, motion.t, history);
}

bool ConstraintElement::command(const SwitchCommand &order, const LocalMotion &motion, double *history) const
{
  const double before = law_->at(motion.t, history).rate;
  if (!law_->command(order, motion.t, history))
    return false;
  if (const double after = law_->at(motion.t, history).rate; differ(before, after))
  {
    std::ostringstream message;
    message << "the command \"" << order.name << "\" makes the speed of the prescribed motion jump from " << before
            << " to " << after
            << ", an impact that an ideal joint cannot transmit; first command \"set\" with an acceleration";
    throw std::domain_error(message.str());
  }
  return true;
}

} // namespace gestell::mechanism
