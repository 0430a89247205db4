#pragma once

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

} // namespace gestell::mechanism
