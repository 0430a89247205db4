#pragma once

#include "mechanism/local_motion.h"

#include <string>
#include <vector>

namespace gestell::mechanism
{

class Branches;
class Commands;
class Constraint;
class ForceLaw;
class Structure;

/// Where the work of an element goes that it does not store: a drive feeds the machine, all else dissipates.
enum class Work
{
  dissipated,
  input
};

/// A scalar an element can tell about itself.
struct Quantity
{
  std::string name; ///< e.g. "force"
  std::string unit; ///< e.g. "N"
};

/**
 * What acts on k scalar measures u = W^T q of the motion of a machine: a ForceLaw, or the Constraint of an ideal joint.
 *
 * The generalised force p [k] (N or N m) is conjugate to the measures; on the coordinates of the machine acts W p, so
 * that its power is p . u'.  W is constant and belongs to whoever places the element.
 *
 * Facets tell what only some elements have; a null pointer: this one has none.  They stay the same for its lifetime.
 */
class Element
{
public:
  virtual ~Element() = default;

  virtual int  n_measures() const = 0;
  virtual Work work() const { return Work::dissipated; }

  /// Size [m, rad] of the numbers whose difference the equations g of a constraint are, or the motion that a force
  /// depends on: rounding leaves so much times epsilon of it.  Zero: that motion is the measures themselves.
  virtual double size_of_terms() const { return 0.; }

  virtual std::vector<Quantity> quantities() const                                                      = 0;
  virtual double                quantity(int i, const LocalMotion &motion, const double *history) const = 0;

  // --- which of the two it is
  virtual const ForceLaw   *force_law() const { return nullptr; }
  virtual const Constraint *ideal_joint() const { return nullptr; }

  // --- facets
  virtual const Branches  *branches() const { return nullptr; }
  virtual const Structure *structure() const { return nullptr; }
  virtual const Commands  *commands() const { return nullptr; }
};

} // namespace gestell::mechanism
