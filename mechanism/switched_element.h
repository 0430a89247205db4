#pragma once

#include "mechanism/facets.h"

#include <memory>

namespace gestell::mechanism
{

/**
 * A force element that the commands "off" and "on" of switches remove from the machine and restore. Off: p = 0, no
 * sticking and no events; its virtual coordinates decay. Its stored energy is dissipated at that instant; a negative
 * store (a preload that has done work) is left unchanged. On: it restarts as at the start of a run; the initial energy
 * of a preloaded spring does not count, its store begins with zero. All other commands go to the element: it accepts
 * them also while off, and they remain in effect when it acts again.
 *
 * Source: docs/theory/switches.md.
 */
class SwitchedElement : public ForceLaw, public Branches, public Structure, public Commands
{
public:
  enum class Begin
  {
    on,
    off
  };

  SwitchedElement(std::shared_ptr<const ForceLaw> law, Begin begin);

  const ForceLaw &law() const { return *law_; }

  int  n_measures() const override { return law_->n_measures(); }
  void force(const LocalMotion &motion, const double *history, double *p) const override;
  void tangent(const LocalMotion &motion, const double *history, const TangentWeights &w, double *p,
               double *dp) const override;
  void derivatives(const LocalMotion &motion, const double *history, double *p, double *dp_du,
                   double *dp_dv) const override;

  /// history: 1 after a change of state; energy offset of switching [J]; that of the law.
  const Branches *branches() const override { return this; }
  int             n_history() const override { return n_slots + mechanism::n_history(*law_); }
  void            start(const LocalMotion &motion, double *history) const override;
  void            accept(const LocalMotion &motion, double *history) const override;
  bool            holds(const double *history, double &rate) const override;

  const Structure *structure() const override { return structure_ ? this : nullptr; }
  /// In the initial state, like closure(), penetration() and play(): they are requested for the structure and the start
  /// of a run only.
  void   engaged(const double *u, double *K, double *D) const override;
  void   stiffest(const double *u, double *K, double *D) const override { structure_->stiffest(u, K, D); }
  void   open_branch(const double *u, double *K, double *D) const override;
  bool   stiffens() const override { return structure_->stiffens(); }
  void   geometric(const LocalMotion &motion, const double *history, double *K) const override;
  bool   closure(const double *u, const double *v, double &g, double *gradient, double &curvature) const override;
  double penetration(const LocalMotion &motion) const override;
  Play   play(const double *u, const double *v, double *G) const override;
  double yielding(double force) const override { return structure_->yielding(force); }

  const Commands *commands() const override { return this; }
  bool            command(const SwitchCommand &order, const LocalMotion &motion, double *history) const override;
  std::vector<std::string> command_names() const override;
  void                     check_order(const SwitchCommand &order) const override;

  double stored_energy(const LocalMotion &motion, const double *history) const override;
  double stored_power(const LocalMotion &motion, const double *history) const override;
  Work   work() const override { return law_->work(); }

  std::vector<Guard> guards(const double *history) const override;
  int                n_guards(const double *history) const override;
  void               guard_values(const LocalMotion &motion, const double *history, double *g) const override;
  void               transition(int i, const LocalMotion &motion, double *history) const override;

  std::vector<Quantity> quantities() const override { return law_->quantities(); }
  /// Forces, torques and powers are zero while it is off.
  double quantity(int i, const LocalMotion &motion, const double *history) const override;

private:
  enum Slot
  {
    changed,
    brought,
    n_slots
  };
  bool is_on(const double *history) const { return (begin_ == Begin::on) == (history[changed] == 0.); }
  bool branches_act(const double *history) const { return branches_ && is_on(history); } ///< those of the law
  void resume_law(const LocalMotion &motion, double *history) const;

  std::shared_ptr<const ForceLaw> law_;
  Begin                           begin_;
  std::vector<char>               is_force_; ///< by quantity: zero while it is off

  // Of the law.
  const Branches  *branches_  = law_->branches();
  const Structure *structure_ = law_->structure();
  const Commands  *commands_  = law_->commands();
};

} // namespace gestell::mechanism
