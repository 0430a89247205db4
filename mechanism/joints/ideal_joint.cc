#include "mechanism/joints/ideal_joint.h"

#include "mechanism/require.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gestell::mechanism
{

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
    const RelativeMeasure &s = equation.measure;
    plain_.emplace_back();
    if (s.form == RelativeMeasure::Form::along && s.carrier == RelativeMeasure::Carrier::space)
    {
      plain_.back() = Plain{{first_, -s.a}, {second_, s.a}};
      ++n_plain_;
    }
  }
  require(driven == is_driven(), "joint", "number of motion laws", is_driven() ? 1. : 0.,
          "one for a driven equation, otherwise none");
}

IdealJoint::Points::Points(const IdealJoint &joint, const LocalMotion &motion, const double *v)
    : u_1(motion.u), u_2(u_1 + joint.first_.n_measures()), v_1(v), v_2(v ? v + joint.first_.n_measures() : nullptr)
{
  if (joint.n_plain_ > 0)
  {
    turn_1 = motion.turns ? motion.turns[0] : PointAlong::turn(joint.first_, u_1);
    turn_2 = motion.turns ? motion.turns[1] : PointAlong::turn(joint.second_, u_2);
  }
  if (joint.n_plain_ == joint.n_constraints())
    return;
  joint.first_.position(u_1, v_1, x_1);
  joint.second_.position(u_2, v_2, x_2);
}

void IdealJoint::constraint(const LocalMotion &motion, const double *history, double *g, double *G) const
{
  const int    n_c = n_constraints();
  const Points now(*this, motion, nullptr);
  const double f = is_driven() ? prescribed(motion.t, history).value : 0.;
  for (int i = 0; i < n_c; ++i)
  {
    const Equation &equation = equations_[i];
    double          s        = 0.;
    if (const auto &plain = plain_[i])
      s = plain->first.value(now.u_1, now.turn_1, G + i, n_c) +
          plain->second.value(now.u_2, now.turn_2, G + i + n_c * first_.n_measures(), n_c);
    else
      s = equation.measure.evaluate({first_, second_, now.x_1, now.x_2}, motion.u, nullptr, G + i, n_c).s;
    g[i] = s - equation.offset - (equation.driven ? f : 0.);
  }
}

void IdealJoint::constraint_rates(const LocalMotion &motion, const double *history, double *rate, double *bias) const
{
  const Points           now(*this, motion, motion.v);
  const PrescribedMotion f = prescribed(motion.t, history);
  double                 G[PlacedMeasure::max_measures];
  for (int i = 0; i < n_constraints(); ++i)
  {
    const Equation &equation = equations_[i];
    if (const auto &plain = plain_[i])
      bias[i] = plain->first.bias(now.u_1, now.v_1, now.turn_1) + plain->second.bias(now.u_2, now.v_2, now.turn_2);
    else
      bias[i] = equation.measure.evaluate({first_, second_, now.x_1, now.x_2}, motion.u, motion.v, G).bias;
    rate[i] = 0.;
    if (!equation.driven)
      continue;
    rate[i] = -f.rate;
    bias[i] -= f.acceleration;
  }
}

std::array<int, 2> IdealJoint::angles() const
{
  const bool needed = n_plain_ > 0;
  return {needed && first_.turns() ? first_.n_measures() - 1 : -1, needed && second_.turns() ? n_measures() - 1 : -1};
}

bool IdealJoint::depends(int equation, int measure) const
{
  const int n_1 = first_.n_measures();
  if (const auto &plain = plain_[equation])
    return measure < n_1 ? plain->first.depends(measure) : plain->second.depends(measure - n_1);
  return true;
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
