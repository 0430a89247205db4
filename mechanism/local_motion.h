#pragma once

namespace gestell::mechanism
{

/// Cosine and sine of the angle of a body; of one that does not turn: 1, 0.
struct Turn
{
  double cosine = 1., sine = 0.;
};

/// Motion of the k measures of one element at one instant: u [k] in m or rad, its rates v = u' and a = u''.
struct LocalMotion
{
  double        t;
  const double *u;
  const double *v;
  const double *a;

  /// Generalised force p [k] of the element at this motion; null if it is unknown.  The guards of a branch with holds()
  /// need it.
  const double *p = nullptr;

  /// Requested branch of the law. true: the branch of the history, smoothly continued beyond its switching points, so
  /// that the law is smooth up to a located event and slightly past it, and force, energy and quantities do not jump by
  /// rounding at a contact. false: the branch of the motion itself.
  bool by_history = false;

  /// Multipliers of an ideal joint [n_constraints()], or of the joint with the element's friction; null for all others,
  /// and if they are unknown.
  const double *lambda = nullptr;

  /// Of both bodies of an ideal joint, see Constraint::angles(); null: not computed yet.
  const Turn *turns = nullptr;
};

} // namespace gestell::mechanism
