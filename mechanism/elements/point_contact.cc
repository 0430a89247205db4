#include "mechanism/elements/point_contact.h"

#include <cmath>

namespace gestell::mechanism
{

// The normal contact acts on the first measure only.

PointContact::PointContact(const Parameters &parameters) : normal_(parameters.normal), friction_(parameters.friction)
{
  friction_.check("contact");
}

void PointContact::engaged(const double *u, double *K, double *) const
{
  double k, d;
  normal_.engaged(u, &k, &d);
  K[0] = k;
}

Play PointContact::play(const double *u, const double *v, double *G) const
{
  G[1] = G[2] = 0.;
  return normal_.play(u, v, G);
}

double PointContact::stored_energy(const LocalMotion &motion, const double *history) const
{
  return normal_.stored_energy(motion, history);
}

double PointContact::stored_power(const LocalMotion &motion, const double *history) const
{
  return normal_.stored_power(motion, history);
}

void PointContact::guard_values(const LocalMotion &motion, const double *history, double *g) const
{
  normal_.guard_values(motion, history, g);
}

void PointContact::transition(int i, const LocalMotion &motion, double *history) const
{
  normal_.transition(i, motion, history);
}

std::vector<Quantity> PointContact::quantities() const
{
  return {{"normal_force", "N"}, {"friction_force", "N"}, {"distance", "m"}, {"sliding_speed", "m/s"}};
}

double PointContact::quantity(int i, const LocalMotion &motion, const double *history) const
{
  double p[3];
  force(motion, history, p);
  switch (i)
  {
  case 0:
    return p[0];
  case 1:
    return std::hypot(p[1], p[2]);
  case 2:
    return motion.u[0];
  default:
    return std::hypot(motion.v[1], motion.v[2]);
  }
}

} // namespace gestell::mechanism
