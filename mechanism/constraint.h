#pragma once

#include "mechanism/element.h"

#include <array>

namespace gestell::mechanism
{

/// Equations g(t, u) = 0 of an ideal joint in its measures: its force is p = G^T lambda, G = dg/du, with multipliers
/// lambda solved by the system.
class Constraint : public Element
{
public:
  const Constraint *ideal_joint() const final { return this; }

  virtual int n_constraints() const = 0;
  /// Measures that are angles of the joint's two bodies, whose cosine and sine its equations need; -1: none.  Several
  /// joints of one body share them.
  virtual std::array<int, 2> angles() const { return {-1, -1}; }
  /// g [n_c] and G = dg/du [n_c x k, column major].
  virtual void constraint(const LocalMotion &motion, const double *history, double *g, double *G) const = 0;
  /// g' = G u' + rate, g'' = G u'' + bias; [n_c] each.
  virtual void constraint_rates(const LocalMotion &motion, const double *history, double *rate, double *bias) const = 0;
  /// False: that entry of G is always zero.
  virtual bool        depends(int equation, int measure) const { return (void)equation, (void)measure, true; }
  virtual std::string constraint_name(int i) const { return (void)i, ""; }

  double size_of_terms() const override { return 1.; }

  /// Whether quantity i follows from the multipliers.
  virtual bool needs_multipliers(int quantity) const { return (void)quantity, true; }
};

} // namespace gestell::mechanism
