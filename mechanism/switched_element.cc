#include "mechanism/switched_element.h"

#include <algorithm>

namespace gestell::mechanism
{

namespace
{
void zero(double *p, int n)
{
  std::fill_n(p, n, 0.);
}
} // namespace

SwitchedElement::SwitchedElement(std::shared_ptr<const ForceLaw> law, Begin begin) : law_(std::move(law)), begin_(begin)
{
  for (const Quantity &quantity : law_->quantities())
    is_force_.push_back(quantity.unit == "N" || quantity.unit == "N m" || quantity.unit == "W");
}

void SwitchedElement::start(const LocalMotion &motion, double *history) const
{
  history[changed] = history[brought] = 0.;
  if (branches_)
    branches_->start(motion, history + n_slots);
}

void SwitchedElement::force(const LocalMotion &motion, const double *history, double *p) const
{
  if (is_on(history))
    law_->force(motion, history + n_slots, p);
  else
    zero(p, n_measures());
}

void SwitchedElement::tangent(const LocalMotion &motion, const double *history, const TangentWeights &w, double *p,
                              double *dp) const
{
  if (is_on(history))
  {
    law_->tangent(motion, history + n_slots, w, p, dp);
    return;
  }
  zero(p, n_measures());
  zero(dp, n_measures() * n_measures());
}

void SwitchedElement::derivatives(const LocalMotion &motion, const double *history, double *p, double *dp_du,
                                  double *dp_dv) const
{
  if (is_on(history))
  {
    law_->derivatives(motion, history + n_slots, p, dp_du, dp_dv);
    return;
  }
  zero(p, n_measures());
  zero(dp_du, n_measures() * n_measures());
  zero(dp_dv, n_measures() * n_measures());
}

bool SwitchedElement::holds(const double *history, double &rate) const
{
  return branches_act(history) && branches_->holds(history + n_slots, rate);
}

void SwitchedElement::engaged(const double *u, double *K, double *D) const
{
  if (begin_ == Begin::on)
    structure_->engaged(u, K, D);
}

void SwitchedElement::open_branch(const double *u, double *K, double *D) const
{
  if (begin_ == Begin::on)
    structure_->open_branch(u, K, D);
}

void SwitchedElement::geometric(const LocalMotion &motion, const double *history, double *K) const
{
  if (is_on(history))
    structure_->geometric(motion, history + n_slots, K);
}

bool SwitchedElement::closure(const double *u, const double *v, double &g, double *gradient, double &curvature) const
{
  return begin_ == Begin::on && structure_->closure(u, v, g, gradient, curvature);
}

void SwitchedElement::resume_law(const LocalMotion &motion, double *history) const
{
  if (branches_)
    branches_->resume(motion, history + n_slots);
}

bool SwitchedElement::command(const SwitchCommand &order, const LocalMotion &motion, double *history) const
{
  if (order.name != "on" && order.name != "off")
  {
    if (!is_on(history)) // corners went by without it
      resume_law(motion, history);
    return commands_ && commands_->command(order, motion, history + n_slots);
  }
  if ((order.name == "on") == is_on(history))
    return true; // it is already
  history[changed] = 1. - history[changed];
  if (!is_on(history))
  {
    history[brought] -= std::min(0., law_->stored_energy(motion, history + n_slots)); // given, not dissipated
    return true;
  }
  resume_law(motion, history);
  history[brought] += law_->stored_energy(motion, history + n_slots);
  return true;
}

std::vector<std::string> SwitchedElement::command_names() const
{
  std::vector<std::string> orders = {"on", "off"};
  for (const std::string &own : mechanism::command_names(*law_))
    orders.push_back(own);
  return orders;
}

void SwitchedElement::check_order(const SwitchCommand &order) const
{
  if (commands_)
    commands_->check_order(order);
}

void SwitchedElement::accept(const LocalMotion &motion, double *history) const
{
  if (branches_act(history))
    branches_->accept(motion, history + n_slots);
}

double SwitchedElement::stored_energy(const LocalMotion &motion, const double *history) const
{
  return (is_on(history) ? law_->stored_energy(motion, history + n_slots) : 0.) - history[brought];
}

double SwitchedElement::stored_power(const LocalMotion &motion, const double *history) const
{
  return is_on(history) ? law_->stored_power(motion, history + n_slots) : 0.;
}

double SwitchedElement::penetration(const LocalMotion &motion) const
{
  return begin_ == Begin::on ? structure_->penetration(motion) : 0.;
}

Play SwitchedElement::play(const double *u, const double *v, double *G) const
{
  return begin_ == Begin::on ? structure_->play(u, v, G) : Play();
}

int SwitchedElement::n_guards(const double *history) const
{
  return branches_act(history) ? branches_->n_guards(history + n_slots) : 0;
}

std::vector<Guard> SwitchedElement::guards(const double *history) const
{
  return branches_act(history) ? branches_->guards(history + n_slots) : std::vector<Guard>{};
}

void SwitchedElement::guard_values(const LocalMotion &motion, const double *history, double *g) const
{
  if (branches_act(history))
    branches_->guard_values(motion, history + n_slots, g);
}

void SwitchedElement::transition(int i, const LocalMotion &motion, double *history) const
{
  branches_->transition(i, motion, history + n_slots);
}

double SwitchedElement::quantity(int i, const LocalMotion &motion, const double *history) const
{
  if (!is_on(history) && is_force_[i])
    return 0.;
  return law_->quantity(i, motion, history + n_slots);
}

} // namespace gestell::mechanism
