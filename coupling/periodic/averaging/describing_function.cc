#include "coupling/periodic/averaging/describing_function.h"

#include <algorithm>
#include <cmath>

namespace gestell::coupling
{

namespace describing
{

DescribingFunction play(double k, double gap, double A)
{
  const double s = gap / A;
  return {0., s < 1. ? k * (2. / M_PI) * (std::acos(s) - s * std::sqrt((1. - s) * (1. + s))) : 0., 0.};
}

DescribingFunction stops(double k_1, double k_2, double gap, double A)
{
  return {0., k_1 + play(k_2, gap, A).stiffness, 0.};
}

/// A negative gap presses always where s < -1.
DescribingFunction one_sided_stop(double k, double gap, double A)
{
  const double s = gap / A;
  if (s >= 1.)
    return {};
  if (s <= -1.)
    return {-k * gap, k, 0.};
  const double root = std::sqrt((1. - s) * (1. + s)), angle = std::acos(s);
  return {k * A / M_PI * (root - s * angle), k / M_PI * (angle - s * root), 0.};
}

DescribingFunction preload(double F, double k, double A)
{
  return {0., k + 4. * F / (M_PI * A), 0.};
}

DescribingFunction cubic(double beta, double A)
{
  return {0., 0.75 * beta * A * A, 0.};
}

DescribingFunction quintic(double beta, double A)
{
  return {0., 0.625 * beta * A * A * A * A, 0.};
}

DescribingFunction coulomb(double F, double A, double omega)
{
  return {0., 0., 4. * F / (M_PI * A * omega)};
}

/// (sqrt(1 + r^2) - 1)/r = r/(sqrt(1 + r^2) + 1) without cancellation.
DescribingFunction coulomb_atan(double F, double eps, double A, double omega)
{
  const double r = A * omega / eps;
  return {0., 0., 4. * F / (M_PI * A * omega) * r / (std::sqrt(1. + r * r) + 1.)};
}

/// E - (1 - m) K by the arithmetic-geometric mean of 1 and sqrt(1 - m):  K = pi/(2 a),  E = K (1 - sum 2^(n-1) c_n^2).
/// Source: Abramowitz, Stegun, Handbook of Mathematical Functions, 17.6.
DescribingFunction coulomb_root(double F, double eps, double A, double omega)
{
  const double r = A * omega / eps, m = r * r / (1. + r * r);
  double       a = 1., b = 1. / std::sqrt(1. + r * r), sum = 0.5 * m, weight = 1.;
  for (int n = 1; n <= 12; ++n, weight *= 2.) // digits double
  {
    const double c    = 0.5 * (a - b);
    const double mean = 0.5 * (a + b);
    b                 = std::sqrt(a * b);
    a                 = mean;
    sum -= weight * c * c;
  }
  return {0., 0., 4. * F / (M_PI * A * omega) * std::sqrt(1. + r * r) / r * sum * M_PI / (2. * a)};
}

DescribingFunction quadratic_damping(double c, double A, double omega)
{
  return {0., 0., 8. / (3. * M_PI) * c * A * omega};
}

DescribingFunction jenkins(double k, double F, double A, double omega)
{
  if (k * A <= F)
    return {0., k, 0.};
  const double theta = std::acos(1. - 2. * F / (k * A));
  return {0., k / M_PI * (theta - 0.5 * std::sin(2. * theta)), 4. * F / (M_PI * A * omega) * (1. - F / (k * A))};
}

} // namespace describing

namespace
{

// Nodes of Kronrod and weights of Kronrod and Gauss on [-1, 1], by halves; the odd nodes are Gauss'.
// Source: Piessens et al., QUADPACK (1983), rule of 15 points.
constexpr double kronrod_nodes[]   = {0.991455371120812639206854697526329, 0.949107912342758524526189684047851,
                                      0.864864423359769072789712788640926, 0.741531185599394439863864773280788,
                                      0.586087235467691130294144691693013, 0.405845151377397166906606412076961,
                                      0.207784955007898467600689403773245, 0.};
constexpr double kronrod_weights[] = {0.022935322010529224963732008058970, 0.063092092629978553290700663189204,
                                      0.104790010322250183839876322541518, 0.140653259715525918745189590510238,
                                      0.169004726639267902826583426598550, 0.190350578064785409913256402421014,
                                      0.204432940075298892414161999234649, 0.209482141084727828012999174891714};
constexpr double gauss_weights[]   = {0.129484966168869693270611432679082, 0.279705391489276667901467771423780,
                                      0.381830050505118944950369775488975, 0.417959183673469387755102040816327};

} // namespace

DescribedForces::DescribedForces(const SecondOrderSystem &system, Eigen::VectorXd d)
    : forces_(system.forces()), d_(std::move(d))
{
  state_.resize(d_.size());
}

DescribedForces::Sums DescribedForces::integrand(double phi)
{
  const double c = std::cos(phi), s = std::sin(phi);
  state_.t = phi / omega_;
  state_.u = u_0_ + A_ * c * d_;
  state_.v = -A_ * omega_ * s * d_;
  state_.a = -A_ * omega_ * omega_ * c * d_;
  forces_.force(state_, state_.p);
  const double force = d_.dot(state_.p);
  Sums         sums(d_.size() + 2);
  sums << state_.p, force * c, force * s;
  largest_ = std::max(largest_, sums.cwiseAbs().maxCoeff());
  return sums;
}

void DescribedForces::kronrod(double from, double to, Sums &fine, Sums &rough)
{
  const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
  fine.setZero(d_.size() + 2);
  rough = fine;
  for (int i = 0; i < 8; ++i)
    for (const int side : {-1, 1})
    {
      if (i == 7 && side == 1)
        continue;
      const Sums value = integrand(middle + side * half * kronrod_nodes[i]);
      fine += half * kronrod_weights[i] * value;
      if (i % 2 == 1)
        rough += half * gauss_weights[i / 2] * value;
    }
}

/// Halves the interval where the rules disagree.  Kinks and jumps make one half disagree, at most both where there are
/// two; where halves of both halves do, it is rounding that no halving mends, as of a force that has only begun.
void DescribedForces::add(double from, double to, int depth, bool twin_disagrees)
{
  const double middle = 0.5 * (from + to), ends[] = {from, middle, to};
  Sums         fine[2], rough[2];
  double       error[2];
  for (int i = 0; i < 2; ++i)
  {
    kronrod(ends[i], ends[i + 1], fine[i], rough[i]);
    error[i] = (fine[i] - rough[i]).cwiseAbs().maxCoeff();
  }
  constexpr double agreement   = 1e-13; // of two rules, of the largest force times the interval
  const double     enough      = agreement * largest_ * (middle - from);
  const bool       both        = error[0] > enough && error[1] > enough;
  constexpr double noise       = 1e-8; // most that intervals of rounding alone may err by, of the largest force [rad]
  const bool       rounded     = both && twin_disagrees && error[0] + error[1] <= noise * largest_;
  constexpr int    most_halves = 52; // of the quarter of a period: to rounding
  for (int i = 0; i < 2; ++i)
    if (depth >= most_halves || rounded || error[i] <= enough)
      sum_ += fine[i];
    else
      add(ends[i], ends[i + 1], depth + 1, both);
}

DescribingFunction DescribedForces::at(const Eigen::VectorXd &u_0, double A, double omega)
{
  u_0_     = u_0;
  A_       = A;
  omega_   = omega;
  largest_ = 0.;
  sum_.setZero(d_.size() + 2);
  constexpr int parts = 4; // quarters, which are halved: what is even in them is seen
  for (int i = 0; i < parts; ++i)
    add(2. * M_PI * i / parts, 2. * M_PI * (i + 1) / parts, 0, false);
  const Eigen::Index n = d_.size();
  mean_                = sum_.head(n) / (2. * M_PI);
  return {-d_.dot(mean_), -sum_[n] / (M_PI * A), sum_[n + 1] / (M_PI * A * omega)};
}

} // namespace gestell::coupling
