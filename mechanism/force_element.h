#pragma once

#include "mechanism/switch_command.h"

#include <string>
#include <vector>

namespace gestell::mechanism
{

/// Motion of the k measures of one element at one instant: u [k] in m or rad, its rates v = u' and a = u''.
struct LocalMotion
{
  double        t;
  const double *u;
  const double *v;
  const double *a;

  /// Generalised force p [k] of the element at this motion; null where it is unknown.  The guards of a branch that
  /// holds() need it.
  const double *p = nullptr;

  /// Which branch of the law is asked for.  true: the one the history names, smoothly continued beyond its switching
  /// points, so that an integrator that locates events sees a smooth law up to an event and slightly past it, and
  /// force, energy and quantities do not jump at a contact that is a rounding error outside.  false: the one the motion
  /// itself is in.
  bool by_history = false;

  /// Multipliers of an ideal joint [n_constraints()], or of the joint whose friction the element is; null for all
  /// others and where they are unknown.
  const double *lambda = nullptr;
};

/// The tangent asked for is  w.u dp/du + w.v dp/dv + w.a dp/da.  An implicit integrator, in which v and a depend
/// linearly on u, needs just this one combination (BDF: w = (1, 1/h_beta, 1/h_beta^2)).
struct TangentWeights
{
  double u, v, a;
};

/// Where the work of an element goes that it does not store: a drive feeds the machine, all else dissipates.
enum class Work
{
  dissipated,
  input
};

enum class Crossing
{
  rising,
  falling
};

/// A switching function of the branch an element is in; the transition happens where it crosses zero in `crossing`.
struct Guard
{
  std::string kind; ///< name of the transition, e.g. "tool_contact"
  Crossing    crossing;
};

/// A scalar an element can tell about itself.
struct Quantity
{
  std::string name; ///< e.g. "force"
  std::string unit; ///< e.g. "N"
};

/**
 * A nonlinear force of the machine, written in k scalar measures u = W^T q of its motion.
 *
 * The element returns the generalised force p [k] (N or N m) conjugate to its measures; on the coordinates of the
 * machine acts W p, so that its power is p . u'.  W is constant and belongs to whoever places the element.
 *
 * Memory (largest penetration, active branch, sliding state) lies outside, in n_history() numbers per element that the
 * system owns, saves and restores as one vector.  force() and tangent() never change it; accept() and transition()
 * do, and are called for accepted motion only.
 *
 * Events.  Inside a branch the law is smooth; guard_values() are the switching functions of the active branch, open on
 * the side from which they may cross: a rising guard while negative, a falling one while positive.  Right after a
 * transition the guard that would take it back has the value zero within the rounding of the location, and the motion
 * carries it to its open side: a guard past zero at the beginning of a step but open at its end is not due.  One that
 * is past zero at both (play of width zero) is due at the beginning: its transition is taken at the same instant as the
 * one before.  Guards of a branch that holds() depend on a force that jumps at the transition: they are judged with the
 * new force before any step is made, and if past zero their transition is taken at once.
 */
class ForceElement
{
public:
  virtual ~ForceElement() = default;

  virtual int n_measures() const = 0;
  virtual int n_history() const { return 0; }

  /// Sets the history for a motion that begins here.
  virtual void start(const LocalMotion &, double *history) const { (void)history; }
  /// The same for an element that acts again after a time in which it did not: orders it has been given go on.
  virtual void resume(const LocalMotion &motion, double *history) const { start(motion, history); }

  /// p [k] for the given motion.
  virtual void force(const LocalMotion &motion, const double *history, double *p) const = 0;

  /// p [k] and its tangent dp [k x k, column major] for the weights w.
  virtual void tangent(const LocalMotion &motion, const double *history, const TangentWeights &w, double *p,
                       double *dp) const = 0;

  /// p [k] with dp/du and dp/dv [k x k each, column major] apart, u'' being held.
  virtual void derivatives(const LocalMotion &motion, const double *history, double *p, double *dp_du,
                           double *dp_dv) const;

  /// true: in the branch named by the history the element's single measure is held at u' = rate and its force p is the
  /// unknown, a constraint force that the system finds; force() and tangent() are then not consulted for p, and
  /// guard_values() and quantity() read motion.p.
  virtual bool holds(const double *history, double &rate) const;

  /// Stiffness K = -dp/du and damping D = -dp/dv [k x k, column major] the element has as part of the structure when
  /// it is engaged (play closed) at the configuration u; geometric stiffness is left out.  Used for natural
  /// frequencies.  Technological forces and drives are no structure: zero, the default.
  virtual void engaged(const double *u, double *K, double *D) const;

  /// Stiffness and damping as above of the stiffest branch of the law near u, technological forces included: what the
  /// step of an integrator has to stand.  Default: engaged().
  virtual void stiffest(const double *u, double *K, double *D) const { engaged(u, K, D); }

  /// Stiffness and damping as engaged() tells them of what acts in every branch of the law, so that it stays when the
  /// element is open: the oil film of a rod with play.  Default: engaged(), of a law without a branch in which it is
  /// open.
  virtual void open_branch(const double *u, double *K, double *D) const { engaged(u, K, D); }

  /// Stiffness grows with the motion itself, so that stiffest() at one place is no bound: a contact after Hertz.
  virtual bool stiffens() const { return false; }

  /// Geometric stiffness [k x k, column major]: of a force that turns with the motion, -d(G^T)/du P, at the forces of
  /// `motion` (of a joint its multipliers).  Together with engaged() it is the tangent.
  virtual void geometric(const LocalMotion &motion, const double *history, double *K) const;

  /// Position function the element closes when it is engaged, g(u) = 0 (compression of a rod, twist of a coupling):
  /// returns false if there is none; else g, its gradient [k] and its second derivative along v, v^T g'' v.
  virtual bool closure(const double *u, const double *v, double &g, double *gradient, double &curvature) const;

  // --- ideal joints
  /// Number of equations g(t, u) = 0 that the element demands of its measures; with any, it is an ideal joint: its
  /// force is p = G^T lambda with multipliers lambda that the system finds, and force() and tangent() are not
  /// consulted.
  virtual int n_constraints() const { return 0; }
  /// g [n_c] and G = dg/du [n_c x k, column major].
  virtual void constraint(const LocalMotion &motion, const double *history, double *g, double *G) const;
  /// g' = G u' + rate, g'' = G u'' + bias; [n_c] each.
  virtual void constraint_rates(const LocalMotion &motion, const double *history, double *rate, double *bias) const;
  /// Size [m, rad] of the numbers whose difference g is, or the motion that the force depends on: rounding leaves so
  /// much times epsilon of it.  Zero: that motion is the measures themselves.
  virtual double      size_of_terms() const { return n_constraints() > 0 ? 1. : 0.; }
  virtual std::string constraint_name(int i) const { return (void)i, ""; }

  /// Obeys an order of a switch at the motion where it is given; false: the element knows no such order.
  virtual bool command(const SwitchCommand &order, const LocalMotion &motion, double *history) const;
  virtual std::vector<std::string> commands() const { return {}; }
  /// @throws std::invalid_argument if the values of one of these orders are none for it
  virtual void check_order(const SwitchCommand &) const {}

  virtual void accept(const LocalMotion &, double *history) const { (void)history; }

  /// Energy [J] stored in the element; what it takes up beyond it is work() .
  virtual double stored_energy(const LocalMotion &, const double *history) const;
  /// Its growth [W] with the motion inside a branch: d stored_energy/du . u'.
  virtual double stored_power(const LocalMotion &, const double *history) const;
  virtual Work   work() const { return Work::dissipated; }

  /// How deep [m or rad] bodies that a contact keeps apart lie in each other; 0: they do not, or nothing keeps them.
  virtual double penetration(const LocalMotion &) const { return 0.; }

  /// Switching functions of the branch that `history` says is active.
  virtual std::vector<Guard> guards(const double *history) const;
  virtual int                n_guards(const double *history) const { return (void)history, 0; }
  virtual void               guard_values(const LocalMotion &motion, const double *history, double *g) const;
  /// Takes the transition of guard i at the motion where it crossed zero.
  virtual void transition(int i, const LocalMotion &motion, double *history) const;

  /// Whether quantity i of an ideal joint follows from its multipliers.
  virtual bool needs_multipliers(int quantity) const { return (void)quantity, n_constraints() > 0; }

  virtual std::vector<Quantity> quantities() const                                                      = 0;
  virtual double                quantity(int i, const LocalMotion &motion, const double *history) const = 0;

protected:
  /// K and D of an element that is nothing while it is open.
  void no_structure(double *K, double *D) const;

  /// -p of an element of one measure: the force it opposes to its motion, what most of them tell as their force.
  double resistance(const LocalMotion &motion, const double *history) const;
};

} // namespace gestell::mechanism
