#pragma once

#include "mechanism/facets.h"
#include "mechanism/measures/combined_measure.h"

#include <memory>
#include <vector>

namespace gestell::mechanism
{

/**
 * A law of one or a few measures s that acts through scalars s(u) of the motion: a spring between two points of
 * rotating bodies, a cylinder, a wheel under a chassis, clearance between cam and follower, a journal.
 *
 *     p = G^T P(s, s'),     G = ds/du,     s' = G u',     s'' = G u'' + u'^T s'' u'
 *
 * Further measures of the law are virtual coordinates, which are passed through unchanged. History, events, energy and
 * quantities are those of the law; kinks of a position function in s are also events. The tangent keeps G constant: its
 * change within a Newton step is of order h^2 P/(m |d|) relative to 1. geometric() is the remainder, -dp/du due to the
 * G in p and s'. The law must not stick: a sticking measure needs a constant direction.
 *
 * Source: principle of virtual work; docs/theory/joints.md (5).
 */
class TransmittedElement : public ForceLaw, public Branches, public Structure, public Commands
{
public:
  static constexpr int max_seen    = 3; ///< scalars s
  static constexpr int max_virtual = 3;

  /// @param law   of one measure, and virtual coordinates
  /// @param rest  value of s at which the measure of the law is zero
  /// @throws std::invalid_argument if the law has more virtual coordinates than max_virtual
  TransmittedElement(const CombinedMeasure &measure, std::shared_ptr<const ForceLaw> law, double rest = 0.);
  /// @param measures  of the relative motion of the two bodies, one for each measure of the law
  /// @throws std::invalid_argument if their number differs from that of the law, or exceeds max_seen
  TransmittedElement(const Placement &first, const Placement &second, const std::vector<RelativeMeasure> &measures,
                     std::shared_ptr<const ForceLaw> law);

  const ForceLaw &law() const { return *law_; }

  int  n_measures() const override { return n_motions() + n_virtual(); }
  void force(const LocalMotion &motion, const double *history, double *p) const override;
  void tangent(const LocalMotion &motion, const double *history, const TangentWeights &w, double *p,
               double *dp) const override;
  void derivatives(const LocalMotion &motion, const double *history, double *p, double *dp_du,
                   double *dp_dv) const override;

  const Structure *structure() const override { return this; }
  void             engaged(const double *u, double *K, double *D) const override;
  void             stiffest(const double *u, double *K, double *D) const override;
  void             open_branch(const double *u, double *K, double *D) const override;
  bool             stiffens() const override { return structure_ && structure_->stiffens(); }
  void             geometric(const LocalMotion &motion, const double *history, double *K) const override;
  double           penetration(const LocalMotion &motion) const override;
  Play             play(const double *u, const double *v, double *G) const override;
  double           yielding(double force) const override { return structure_ ? structure_->yielding(force) : 0.; }

  double size_of_terms() const override;
  double stored_energy(const LocalMotion &motion, const double *history) const override;
  double stored_power(const LocalMotion &motion, const double *history) const override;
  Work   work() const override { return law_->work(); }

  const Branches *branches() const override { return branches_ || function().n_guards() > 0 ? this : nullptr; }
  /// history: that of the law, then that of the position function.
  int                n_history() const override { return n_of_law_ + function().n_history(); }
  void               start(const LocalMotion &motion, double *history) const override;
  void               resume(const LocalMotion &motion, double *history) const override;
  void               accept(const LocalMotion &motion, double *history) const override;
  std::vector<Guard> guards(const double *history) const override;
  int  n_guards(const double *history) const override { return n_guards_of_law(history) + function().n_guards(); }
  void guard_values(const LocalMotion &motion, const double *history, double *g) const override;
  void transition(int i, const LocalMotion &motion, double *history) const override;

  const Commands *commands() const override { return commands_ ? this : nullptr; }
  bool            command(const SwitchCommand &order, const LocalMotion &motion, double *history) const override;
  std::vector<std::string> command_names() const override { return commands_->command_names(); }
  void                     check_order(const SwitchCommand &order) const override { commands_->check_order(order); }

  std::vector<Quantity> quantities() const override { return law_->quantities(); }
  double                quantity(int i, const LocalMotion &motion, const double *history) const override;

private:
  static constexpr int max_of_law = max_seen + max_virtual;

  /// The motion of the law's measures; G [k x n_seen, column major].
  struct Kinematics
  {
    double G[max_seen * CombinedMeasure::max_measures];
    double s[max_of_law], rate[max_of_law], acceleration[max_of_law];

    LocalMotion motion(const LocalMotion &of) const
    {
      return {of.t, s, rate, acceleration, nullptr, of.by_history, of.lambda};
    }
  };
  int        n_seen() const { return int(measures_.size()); }
  int        n_motions() const { return measures_.front().n_measures(); }
  int        n_guards_of_law(const double *history) const { return branches_ ? branches_->n_guards(history) : 0; }
  int        n_virtual() const { return law_->n_measures() - n_seen(); }
  Kinematics kinematics_of(const LocalMotion &motion, const double *history) const;
  /// p = G^T P followed by the P of virtual coordinates; for a derivative of P by the law's measures the same by u.
  void spread(const Kinematics &kinematics, const double *P, double *p) const;
  void spread_tangent(const Kinematics &kinematics, const double *dP, double *dp) const;
  /// K and D of the law by one of the functions of facets.h, for the measures of the motion.
  using Matrices = void (*)(const Element &law, const double *u, double *K, double *D);
  void spread_structure(Matrices matrices, const double *u, double *K, double *D) const;

  const double *of_function(const LocalMotion &motion, const double *history) const
  {
    return motion.by_history ? history + n_of_law_ : nullptr;
  }

  /// The measure that can have a position function, whose kinks are events.
  const CombinedMeasure &function() const { return measures_.front(); }

  std::vector<CombinedMeasure>    measures_;
  std::shared_ptr<const ForceLaw> law_;
  double                          rest_;

  // Of the law.
  const Branches  *branches_  = law_->branches();
  const Structure *structure_ = law_->structure();
  const Commands  *commands_  = law_->commands();
  int              n_of_law_  = mechanism::n_history(*law_);
};

} // namespace gestell::mechanism
