#pragma once

#include "mechanism/combined_measure.h"
#include "mechanism/force_element.h"

#include <memory>

namespace gestell::mechanism
{

/**
 * A law of one measure s that acts through a scalar s(u) of the motion: a spring between two points of turning bodies,
 * a cylinder, a wheel under a chassis, the play between cam and follower.
 *
 *     p = G^T P(s, s'),     G = ds/du,     s' = G u',     s'' = G u'' + u'^T s'' u'
 *
 * Measures of the law behind the first one are virtual coordinates, taken over as they are.  Everything else (history,
 * events, energy, quantities) is the law's, and the kinks of a position function in s are events too.  The tangent
 * holds G: how it turns within a Newton step is of the order of h^2 P/(m |d|) against 1.
 *
 * The law must not hold its measure (true sticking): a held measure has a constant direction.
 *
 * Source: principle of virtual work; docs/theory/joints.md (5).
 */
class TransmittedElement : public ForceElement
{
public:
  /// @param law   of one measure, and virtual coordinates
  /// @param rest  value of s that the law sees as zero
  /// @throws std::invalid_argument if the law has more of them than max_virtual
  TransmittedElement(const CombinedMeasure &measure, std::shared_ptr<const ForceElement> law, double rest = 0.);

  static constexpr int max_virtual = 3;

  int n_measures() const override { return n_motions() + n_virtual(); }
  /// history: that of the law, then that of the position function.
  int  n_history() const override { return law_->n_history() + measure_.n_history(); }
  void start(const LocalMotion &motion, double *history) const override;
  void force(const LocalMotion &motion, const double *history, double *p) const override;
  void tangent(const LocalMotion &motion, const double *history, const TangentWeights &w, double *p,
               double *dp) const override;
  void derivatives(const LocalMotion &motion, const double *history, double *p, double *dp_du,
                   double *dp_dv) const override;
  void engaged(const double *u, double *K, double *D) const override;
  void stiffest(const double *u, double *K, double *D) const override;
  void geometric(const LocalMotion &motion, const double *history, double *K) const override;
  void accept(const LocalMotion &motion, double *history) const override;

  double stored_energy(const LocalMotion &motion, const double *history) const override;
  Work   work() const override { return law_->work(); }

  std::vector<Guard> guards(const double *history) const override;
  int  n_guards(const double *history) const override { return law_->n_guards(history) + measure_.n_guards(); }
  void guard_values(const LocalMotion &motion, const double *history, double *g) const override;
  void transition(int i, const LocalMotion &motion, double *history) const override;
  bool command(const std::string &order, const LocalMotion &motion, double *history) const override;
  std::vector<std::string> commands() const override { return law_->commands(); }

  std::vector<Quantity> quantities() const override { return law_->quantities(); }
  double                quantity(int i, const LocalMotion &motion, const double *history) const override;

private:
  static constexpr int max_of_law = 1 + max_virtual;

  /// The motion of the law's measures.
  struct Seen
  {
    double G[CombinedMeasure::max_measures];
    double s[max_of_law], rate[max_of_law], acceleration[max_of_law];

    LocalMotion motion(const LocalMotion &of) const { return {of.t, s, rate, acceleration, nullptr, of.by_history}; }
  };
  int  n_motions() const { return measure_.n_measures(); }
  int  n_virtual() const { return law_->n_measures() - 1; }
  Seen see(const LocalMotion &motion, const double *history) const;
  /// p = (G^T P_1, P_2 ..) and, of a derivative of P by the law's measures, that by u.
  void spread(const Seen &seen, const double *P, double *p) const;
  void spread_tangent(const Seen &seen, const double *dP, double *dp) const;

  const double *of_function(const LocalMotion &motion, const double *history) const
  {
    return motion.by_history ? history + law_->n_history() : nullptr;
  }

  CombinedMeasure                     measure_;
  std::shared_ptr<const ForceElement> law_;
  double                              rest_;
};

} // namespace gestell::mechanism
