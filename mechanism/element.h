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

/// Kind of non-stored work of an element: input of a drive, otherwise dissipation.
enum class Work
{
  dissipated,
  input
};

/// A scalar signal of an element.
struct Quantity
{
  std::string name; ///< e.g. "force"
  std::string unit; ///< e.g. "N"
};

/**
 * An element acting on k scalar measures u = W^T q of the motion of a machine: a ForceLaw, or the Constraint of an
 * ideal joint.
 *
 * The generalised force p [k] (N or N m) is conjugate to the measures; the force on the coordinates of the machine is W
 * p, its power p . u'. W is constant and owned by the caller. Facets are optional interfaces; a null pointer: not
 * provided. They are constant for its lifetime.
 */
class Element
{
public:
  virtual ~Element() = default;

  virtual int  n_measures() const = 0;
  virtual Work work() const { return Work::dissipated; }

  /// Size [m, rad] of the terms in the equations g of a constraint, or in the motion that a force depends on; rounding
  /// is epsilon times this. Zero: the measures themselves.
  virtual double size_of_terms() const { return 0.; }

  virtual std::vector<Quantity> quantities() const                                                      = 0;
  virtual double                quantity(int i, const LocalMotion &motion, const double *history) const = 0;

  // --- kind of element
  virtual const ForceLaw   *force_law() const { return nullptr; }
  virtual const Constraint *ideal_joint() const { return nullptr; }

  // --- facets
  virtual const Branches  *branches() const { return nullptr; }
  virtual const Structure *structure() const { return nullptr; }
  virtual const Commands  *commands() const { return nullptr; }
};

} // namespace gestell::mechanism
