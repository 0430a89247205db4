#include "mechanism/joints/compliant_joint.h"

#include "mechanism/require.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gestell::mechanism
{

namespace
{
constexpr double at_rest[PlacedMeasure::max_measures] = {}; ///< rates
}

CompliantJoint::CompliantJoint(const Placement &first, const Placement &second, std::vector<Equation> equations)
    : first_(first), second_(second), equations_(std::move(equations))
{
  require(!equations_.empty() && n_equations() <= max_equations, "compliant joint", "number of equations",
          n_equations(), "1 to " + std::to_string(max_equations));
  for (const Equation &equation : equations_)
  {
    const std::string place = "compliant joint " + equation.demand.name;
    require(!equation.demand.driven, place, "number of motion laws", 1., "none; only an ideal joint can have one");
    require(equation.stiffness >= 0., place, "stiffness", equation.stiffness, "zero or positive");
    require(equation.damping >= 0., place, "damping", equation.damping, "zero or positive");
  }
}

void CompliantJoint::kinematics_of(const double *u, const double *v, Kinematics &kinematics) const
{
  Placement::MovedVector x_1, x_2;
  const int              k_1 = first_.n_measures(), k = n_measures();
  first_.position(u, v, x_1);
  second_.position(u + k_1, v + k_1, x_2);
  for (int i = 0; i < n_equations(); ++i)
  {
    const Equation &equation = equations_[i];
    const auto      value =
        equation.demand.measure.evaluate({first_, second_, x_1, x_2}, u, v, kinematics.G + Eigen::Index(i) * k);
    kinematics.s[i]      = value.s - equation.demand.offset;
    kinematics.rate[i]   = value.rate;
    kinematics.lambda[i] = -equation.stiffness * kinematics.s[i] - equation.damping * value.rate;
  }
}

void CompliantJoint::spread(const Kinematics &kinematics, double *p) const
{
  const int k = n_measures();
  std::fill_n(p, k, 0.);
  for (int i = 0; i < n_equations(); ++i)
    for (int j = 0; j < k; ++j)
      p[j] += kinematics.G[j + k * i] * kinematics.lambda[i];
}

void CompliantJoint::add_up(const Kinematics &kinematics, double w_k, double w_d, double *matrix) const
{
  const int k = n_measures();
  std::fill_n(matrix, k * k, 0.);
  for (int i = 0; i < n_equations(); ++i)
  {
    const double *G = kinematics.G + Eigen::Index(i) * k,
                 c  = w_k * equations_[i].stiffness + w_d * equations_[i].damping;
    for (int b = 0; b < k; ++b)
      if (const double column = c * G[b]; column != 0.) // most directions move few of the measures
        for (int a = 0; a < k; ++a)
          matrix[a + k * b] += G[a] * column;
  }
}

void CompliantJoint::force(const LocalMotion &motion, const double *, double *p) const
{
  Kinematics kinematics;
  kinematics_of(motion.u, motion.v, kinematics);
  spread(kinematics, p);
}

void CompliantJoint::tangent(const LocalMotion &motion, const double *, const TangentWeights &w, double *p,
                             double *dp) const
{
  Kinematics kinematics;
  kinematics_of(motion.u, motion.v, kinematics);
  spread(kinematics, p);
  add_up(kinematics, -w.u, -w.v, dp);
}

void CompliantJoint::derivatives(const LocalMotion &motion, const double *, double *p, double *dp_du,
                                 double *dp_dv) const
{
  Kinematics kinematics;
  kinematics_of(motion.u, motion.v, kinematics);
  spread(kinematics, p);
  add_up(kinematics, -1., 0., dp_du);
  add_up(kinematics, 0., -1., dp_dv);
}

void CompliantJoint::engaged(const double *u, double *K, double *D) const
{
  Kinematics kinematics;
  kinematics_of(u, at_rest, kinematics);
  add_up(kinematics, 1., 0., K);
  add_up(kinematics, 0., 1., D);
}

void CompliantJoint::geometric(const LocalMotion &motion, const double *, double *K) const
{
  Kinematics kinematics;
  kinematics_of(motion.u, motion.v, kinematics);
  const int k = n_measures();
  for (int e = 0; e < n_equations(); ++e)
  {
    double S[PlacedMeasure::max_measures * PlacedMeasure::max_measures] = {}; // s''
    PlacedMeasure{first_, second_, equations_[e].demand.measure}.add_curvature(motion.u, 1., S);
    for (int j = 0; j < k; ++j)
    {
      double turned = 0.; // of s' by u_j
      for (int i = 0; i < k; ++i)
        turned += S[i + k * j] * motion.v[i];
      for (int i = 0; i < k; ++i)
        K[i + k * j] += equations_[e].damping * kinematics.G[i + k * e] * turned - kinematics.lambda[e] * S[i + k * j];
    }
  }
}

double CompliantJoint::stored_energy(const LocalMotion &motion, const double *) const
{
  Kinematics kinematics;
  kinematics_of(motion.u, motion.v, kinematics);
  double energy = 0.;
  for (int i = 0; i < n_equations(); ++i)
    energy += 0.5 * equations_[i].stiffness * kinematics.s[i] * kinematics.s[i];
  return energy;
}

double CompliantJoint::stored_power(const LocalMotion &motion, const double *) const
{
  Kinematics kinematics;
  kinematics_of(motion.u, motion.v, kinematics);
  double power = 0.;
  for (int i = 0; i < n_equations(); ++i)
    power += equations_[i].stiffness * kinematics.s[i] * kinematics.rate[i];
  return power;
}

std::vector<Quantity> CompliantJoint::quantities() const
{
  std::vector<Quantity> quantities;
  for (const Equation &equation : equations_)
    quantities.push_back({equation.demand.name, equation.demand.unit});
  quantities.push_back({"resultant", "N"});
  return quantities;
}

double CompliantJoint::quantity(int i, const LocalMotion &motion, const double *) const
{
  Kinematics kinematics;
  kinematics_of(motion.u, motion.v, kinematics);
  if (i < n_equations())
    return equations_[i].told_as_described ? along_as_described(i, motion.u, kinematics) : kinematics.lambda[i];
  double sum = 0.;
  for (int j = 0; j < n_equations(); ++j)
    if (equations_[j].demand.unit == "N")
      sum += kinematics.lambda[j] * kinematics.lambda[j];
  return std::sqrt(sum);
}

double CompliantJoint::along_as_described(int i, const double *u, const Kinematics &kinematics) const
{
  double force = 0.;
  for (int j = 0; j < n_equations(); ++j)
    if (equations_[j].told_as_described)
      force += kinematics.lambda[j] *
               equations_[i].demand.measure.a.dot(first_.direction(equations_[j].demand.measure.a, u));
  return force;
}

RelativeMeasure::Value CompliantJoint::opening(int i, const double *u, const double *v, double *gradient) const
{
  const IdealJoint::Equation &demand = equations_[i].demand;
  auto                        value  = PlacedMeasure{first_, second_, demand.measure}.evaluate(u, v, gradient);
  value.s -= demand.offset;
  return value;
}

} // namespace gestell::mechanism
