#pragma once

#include "mechanism/element.h"

namespace gestell::mechanism
{

/// The requested tangent is w.u dp/du + w.v dp/dv + w.a dp/da.  An implicit integrator, in which v and a depend
/// linearly on u, needs just this one combination (BDF: w = (1, 1/h_beta, 1/h_beta^2)).
struct TangentWeights
{
  double u, v, a;
};

/// A nonlinear force p(t, u, u', u'', history) of the machine; force() and tangent() never change the history.
class ForceLaw : public Element
{
public:
  const ForceLaw *force_law() const final { return this; }

  /// p [k] for the given motion.
  virtual void force(const LocalMotion &motion, const double *history, double *p) const = 0;

  /// p [k] and its tangent dp [k x k, column major] for the weights w.
  virtual void tangent(const LocalMotion &motion, const double *history, const TangentWeights &w, double *p,
                       double *dp) const = 0;

  /// p [k] with dp/du and dp/dv [k x k each, column major] separately, at constant u''.
  virtual void derivatives(const LocalMotion &motion, const double *history, double *p, double *dp_du,
                           double *dp_dv) const;

  /// Energy [J] stored in the element; the rest of its work is of the kind work().
  virtual double stored_energy(const LocalMotion &, const double *history) const;
  /// Its growth [W] with the motion inside a branch: d stored_energy/du . u'.
  virtual double stored_power(const LocalMotion &, const double *history) const;

protected:
  /// -p of an element of one measure: the force against its motion, the force signal of most elements.
  double resistance(const LocalMotion &motion, const double *history) const;
};

} // namespace gestell::mechanism
