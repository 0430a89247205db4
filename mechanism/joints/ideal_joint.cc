#include "mechanism/joints/ideal_joint.h"

#include "mechanism/require.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gestell::mechanism
{

using MovedVector = Placement::MovedVector;

IdealJoint::IdealJoint(const Placement &first, const Placement &second, std::vector<Equation> equations,
                       std::shared_ptr<const MotionLaw> law)
    : ConstraintElement(std::move(law)), first_(first), second_(second), equations_(std::move(equations))
{
  require(!equations_.empty(), "joint", "number of equations", 0., "one or more");
  bool driven = false;
  for (const Equation &equation : equations_)
  {
    driven = driven || equation.driven;
    if (equation.measure.form == RelativeMeasure::Form::ratio)
      require(int(equation.measure.ratios.size()) == n_measures(), "joint " + equation.name, "number of ratios",
              double(equation.measure.ratios.size()), "that of the measures, " + std::to_string(n_measures()));
    if (equation.measure.form == RelativeMeasure::Form::distance)
      require(equation.offset >= 0., "joint " + equation.name, "distance [m]", equation.offset, "zero or positive");
  }
  require(driven == is_driven(), "joint", "number of motion laws", is_driven() ? 1. : 0.,
          "one if an equation is driven, else none");
}

namespace
{

/// a . (x_2 - x_1) with a fixed in space: the usual equation of a pin, without the general measure's overhead.
bool is_plain(const RelativeMeasure &measure)
{
  return measure.form == RelativeMeasure::Form::along && measure.carrier == RelativeMeasure::Carrier::space;
}

/// Its gradient, in every `stride`-th entry.
void set_gradient(const Vector3d &a, const MovedVector &x_1, const MovedVector &x_2, double *gradient, int stride)
{
  for (Eigen::Index k = 0; k < x_1.J.cols(); ++k, gradient += stride)
    *gradient = -a.dot(x_1.J.col(k));
  for (Eigen::Index k = 0; k < x_2.J.cols(); ++k, gradient += stride)
    *gradient = a.dot(x_2.J.col(k));
}

} // namespace

void IdealJoint::constraint(const LocalMotion &motion, const double *history, double *g, double *G) const
{
  const int   n_c = n_constraints();
  MovedVector x_1, x_2;
  first_.position(motion.u, nullptr, x_1);
  second_.position(motion.u + first_.n_measures(), nullptr, x_2);
  const double f = is_driven() ? prescribed(motion.t, history).value : 0.;
  for (int i = 0; i < n_c; ++i)
  {
    const Equation &equation = equations_[i];
    double          s        = 0.;
    if (is_plain(equation.measure))
    {
      set_gradient(equation.measure.a, x_1, x_2, G + i, n_c);
      s = equation.measure.a.dot(x_2.value - x_1.value);
    }
    else
      s = equation.measure.evaluate({first_, second_, x_1, x_2}, motion.u, nullptr, G + i, n_c).s;
    g[i] = s - equation.offset - (equation.driven ? f : 0.);
  }
}

void IdealJoint::constraint_rates(const LocalMotion &motion, const double *history, double *rate, double *bias) const
{
  MovedVector x_1, x_2;
  first_.position(motion.u, motion.v, x_1);
  second_.position(motion.u + first_.n_measures(), motion.v + first_.n_measures(), x_2);
  const PrescribedMotion f = prescribed(motion.t, history);
  double                 G[PlacedMeasure::max_measures];
  for (int i = 0; i < n_constraints(); ++i)
  {
    const Equation &equation = equations_[i];
    bias[i]                  = is_plain(equation.measure)
                                   ? equation.measure.a.dot(x_2.bias - x_1.bias)
                                   : equation.measure.evaluate({first_, second_, x_1, x_2}, motion.u, motion.v, G).bias;
    rate[i]                  = 0.;
    if (!equation.driven)
      continue;
    rate[i] = -f.rate;
    bias[i] -= f.acceleration;
  }
}

double IdealJoint::driven_value(const double *u) const
{
  const double at_rest[PlacedMeasure::max_measures] = {};
  double       G[PlacedMeasure::max_measures];
  for (const Equation &equation : equations_)
    if (equation.driven)
      return PlacedMeasure{first_, second_, equation.measure}.evaluate(u, at_rest, G).s;
  return 0.;
}

double IdealJoint::size_of_terms() const
{
  double size = first_.size() + second_.size();
  for (const Equation &equation : equations_)
    size = std::max(size, std::abs(equation.offset));
  return size > 0. ? size : 1.;
}

void IdealJoint::geometric(const LocalMotion &motion, const double *, double *K) const
{
  for (int i = 0; motion.lambda && i < n_constraints(); ++i)
    PlacedMeasure{first_, second_, equations_[i].measure}.add_curvature(motion.u, -motion.lambda[i], K);
}

std::vector<Quantity> IdealJoint::quantities() const
{
  std::vector<Quantity> quantities;
  for (const Equation &equation : equations_)
    quantities.push_back({equation.name, equation.unit});
  quantities.push_back({"resultant", "N"});
  return quantities;
}

double IdealJoint::quantity(int i, const LocalMotion &motion, const double *) const
{
  if (!motion.lambda)
    return std::nan("");
  if (i < n_constraints())
    return motion.lambda[i];
  double sum = 0.;
  for (int j = 0; j < n_constraints(); ++j)
    if (equations_[j].unit == "N")
      sum += motion.lambda[j] * motion.lambda[j];
  return std::sqrt(sum);
}

} // namespace gestell::mechanism
