#include "mechanism/elements/connecting_rod.h"

#include "mechanism/require.h"

#include <cmath>

namespace gestell::mechanism
{

ConnectingRod::ConnectingRod(const Parameters &parameters) : parameters_(parameters)
{
  const auto &[r, l, c, b, p0, s_cl, b_O] = parameters_;
  const std::string name                  = "connecting rod";
  require(r > 0., name, "crank_radius [m]", r, "positive");
  require(l > r, name, "length [m]", l, "longer than the crank radius");
  require(c > 0., name, "stiffness [N/m]", c, "positive");
  require(b >= 0., name, "damping [N s/m]", b, "zero or positive");
  require(p0 > 0., name, "closing_length [m]", p0, "positive");
  require(s_cl >= 0., name, "clearance [m]", s_cl, "zero or positive");
  require(b_O >= 0., name, "oil_damping [N s/m]", b_O, "zero or positive");
}

double ConnectingRod::rate(const LocalMotion &motion) const
{
  double gradient[3];
  compression(motion.u, gradient);
  return gradient[0] * motion.v[0] + gradient[1] * motion.v[1] + gradient[2] * motion.v[2];
}

void ConnectingRod::start(const LocalMotion &motion, double *history) const
{
  double gradient[3];
  history[0] = branch_at(compression(motion.u, gradient));
}

void ConnectingRod::chain_matrices(const double *u, double stiffness, double damping, double *K, double *D) const
{
  double g[3];
  compression(u, g);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
    {
      K[i + 3 * j] = stiffness * g[i] * g[j];
      D[i + 3 * j] = damping * g[i] * g[j];
    }
}

void ConnectingRod::engaged(const double *u, double *K, double *D) const
{
  chain_matrices(u, parameters_.stiffness, parameters_.damping + parameters_.oil_damping, K, D);
}

void ConnectingRod::open_branch(const double *u, double *K, double *D) const
{
  chain_matrices(u, 0., parameters_.oil_damping, K, D);
}

bool ConnectingRod::closure(const double *u, const double *v, double &g, double *gradient, double &curvature) const
{
  g              = compression(u, gradient);
  const double r = parameters_.crank_radius, l = parameters_.length;
  const double c = r * std::sin(u[0]) + u[2], w = std::sqrt(l * l - c * c);
  const double c_rate = r * std::cos(u[0]) * v[0] + v[2]; // c' ; w' = -c c'/w
  curvature           = r * std::cos(u[0]) * v[0] * v[0] + r * std::sin(u[0]) * v[0] * v[0] * c / w -
              c_rate * c_rate * (1. / w + c * c / (w * w * w));
  return true;
}

/// s = delta + s_cl/2: closed under compression above, under tension below.
Play ConnectingRod::play(const double *u, const double *v, double *G) const
{
  Play   play;
  double delta;
  play.n   = 1;
  play.gap = 0.5 * parameters_.clearance;
  closure(u, v, delta, G, play.bias[0]);
  play.s[0]    = delta + play.gap;
  play.rate[0] = G[0] * v[0] + G[1] * v[1] + G[2] * v[2];
  return play;
}

double ConnectingRod::stored_energy(const LocalMotion &motion, const double *history) const
{
  const double e = deflection(motion, history);
  return 0.5 * parameters_.stiffness * e * e;
}

double ConnectingRod::stored_power(const LocalMotion &motion, const double *history) const
{
  return parameters_.stiffness * deflection(motion, history) * rate(motion);
}

/// Deflection of the closed chain, compression positive.
double ConnectingRod::deflection(const LocalMotion &motion, const double *history) const
{
  double       gradient[3];
  const double delta  = compression(motion.u, gradient);
  const Branch branch = branch_for(motion.by_history, history, delta);
  return branch == compressed ? delta : branch == pulled ? delta + parameters_.clearance : 0.;
}

int ConnectingRod::n_guards(const double *history) const
{
  return branch_of(history) == gap ? 2 : 1;
}

std::vector<Guard> ConnectingRod::guards(const double *history) const
{
  switch (branch_of(history))
  {
  case compressed:
    return {{"conrod_open", Crossing::falling}};
  case pulled:
    return {{"conrod_leave_tension", Crossing::rising}};
  default:
    return {{"conrod_close_compression", Crossing::rising}, {"conrod_close_tension", Crossing::falling}};
  }
}

void ConnectingRod::guard_values(const LocalMotion &motion, const double *history, double *g) const
{
  double       gradient[3];
  const double delta  = compression(motion.u, gradient);
  const Branch branch = branch_of(history);
  g[0]                = branch == pulled ? delta + parameters_.clearance : delta;
  if (branch == gap)
    g[1] = delta + parameters_.clearance;
}

void ConnectingRod::transition(int i, const LocalMotion &, double *history) const
{
  const Branch branch = branch_of(history);
  history[0]          = branch != gap ? gap : i == 0 ? compressed : pulled;
}

std::vector<Quantity> ConnectingRod::quantities() const
{
  return {{"force", "N"}, {"compression", "m"}, {"compression_rate", "m/s"}, {"rod_force", "N"}, {"side_force", "N"}};
}

double ConnectingRod::quantity(int i, const LocalMotion &motion, const double *history) const
{
  double       gradient[3];
  const double delta = compression(motion.u, gradient);
  if (i == 1)
    return delta;
  const double delta_rate = rate(motion);
  if (i == 2)
    return delta_rate;
  const Branch branch = branch_for(motion.by_history, history, delta);
  const double push = chain_force(branch, delta, delta_rate), tan_psi = -gradient[2];
  return i == 0 ? push : i == 3 ? push * std::sqrt(1. + tan_psi * tan_psi) : push * tan_psi;
}

} // namespace gestell::mechanism
