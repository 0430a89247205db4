#pragma once

#include "mechanism/force_element.h"
#include "mechanism/relative_measure.h"

#include <memory>

namespace gestell::mechanism
{

/**
 * A law of one measure s that acts through a relative measure s(u) of two places: a spring between two points of
 * turning bodies, a cylinder, a wheel under a chassis.
 *
 *     p = G^T P(s, s'),     G = ds/du,     s' = G u',     s'' = G u'' + u'^T s'' u'
 *
 * Everything else (history, events, energy, quantities) is the law's.  The tangent holds G: how it turns within a
 * Newton step is of the order of h^2 P/(m |d|) against 1.
 *
 * The law must not hold its measure (true sticking): a held measure has a constant direction.
 *
 * Source: principle of virtual work; docs/theory/joints.md (5).
 */
class TransmittedElement : public ForceElement
{
public:
  /// @param law   of one measure
  /// @param rest  value of s that the law sees as zero
  /// @throws std::invalid_argument if the law has not one measure
  TransmittedElement(const PlacedMeasure &measure, std::shared_ptr<const ForceElement> law, double rest = 0.);

  int  n_measures() const override { return measure_.n_measures(); }
  int  n_history() const override { return law_->n_history(); }
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

  std::vector<Guard>       guards(const double *history) const override { return law_->guards(history); }
  int                      n_guards(const double *history) const override { return law_->n_guards(history); }
  void                     guard_values(const LocalMotion &motion, const double *history, double *g) const override;
  void                     transition(int i, const LocalMotion &motion, double *history) const override;
  bool                     command(const std::string &order, const LocalMotion &motion, double *history) const override;
  std::vector<std::string> commands() const override { return law_->commands(); }

  std::vector<Quantity> quantities() const override { return law_->quantities(); }
  double                quantity(int i, const LocalMotion &motion, const double *history) const override;

private:
  /// The motion of s as the law sees it.
  struct Seen
  {
    double G[PlacedMeasure::max_measures];
    double s, rate, acceleration;

    LocalMotion motion(const LocalMotion &of) const { return {of.t, &s, &rate, &acceleration, nullptr, of.by_history}; }
  };
  Seen see(const LocalMotion &motion) const;
  void spread(const Seen &seen, double factor, double *matrix) const; ///< factor G^T G

  PlacedMeasure                       measure_;
  std::shared_ptr<const ForceElement> law_;
  double                              rest_;
};

} // namespace gestell::mechanism
