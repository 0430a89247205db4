#include "mechanism/joints/measure_joint.h"

#include "mechanism/functions/slope_jump.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace gestell::mechanism
{
namespace
{

/// Refuses a jump, at which masses would change their speed without a finite force.
void refuse_jump(const std::string &kink, const std::string &what, double before, double after)
{
  if (!differ(before, after))
    return;
  std::ostringstream message;
  message << what << " jumps from " << before << " to " << after << " (" << kink
          << "), an impact that an ideal joint cannot transmit; smooth the function there, or let it act through a "
             "spring: an element on a measure of type \"position function\", instead of the joint";
  throw std::domain_error(message.str());
}

} // namespace

MeasureJoint::MeasureJoint(const Parameters &parameters, std::shared_ptr<const MotionLaw> law)
    : ConstraintElement(std::move(law)), parameters_(parameters)
{
}

void MeasureJoint::constraint(const LocalMotion &motion, const double *history, double *g, double *G) const
{
  const auto s = measure().evaluate(motion.u, motion.v, G, of_function(motion, history)).s;
  *g           = s - parameters_.offset - prescribed(motion.t, history).value;
  if (measure().wraps()) // the angle is known up to full turns, its law may exceed one
    *g = std::remainder(*g, 2. * M_PI);
}

void MeasureJoint::constraint_rates(const LocalMotion &motion, const double *history, double *rate, double *bias) const
{
  double     G[CombinedMeasure::max_measures];
  const auto f = prescribed(motion.t, history);
  *rate        = -f.rate;
  *bias        = measure().evaluate(motion.u, motion.v, G, of_function(motion, history)).bias - f.acceleration;
}

double MeasureJoint::driven_value(const double *u) const
{
  const double at_rest[CombinedMeasure::max_measures] = {};
  double       G[CombinedMeasure::max_measures];
  return measure().evaluate(u, at_rest, G).s;
}

double MeasureJoint::size_of_terms() const
{
  return std::max(measure().size(), std::abs(parameters_.offset));
}

void MeasureJoint::geometric(const LocalMotion &motion, const double *history, double *K) const
{
  if (motion.lambda)
    measure().add_curvature(motion.u, -*motion.lambda, K, of_function(motion, history));
}

void MeasureJoint::start(const LocalMotion &motion, double *history) const
{
  ConstraintElement::start(motion, history);
  measure().start(motion.u, motion.v, history + ConstraintElement::n_history());
}

std::vector<Guard> MeasureJoint::guards(const double *history) const
{
  auto       guards = ConstraintElement::guards(history);
  const auto own    = measure().guards(history + ConstraintElement::n_history());
  guards.insert(guards.end(), own.begin(), own.end());
  return guards;
}

void MeasureJoint::guard_values(const LocalMotion &motion, const double *history, double *g) const
{
  ConstraintElement::guard_values(motion, history, g);
  measure().guard_values(motion.u, history + ConstraintElement::n_history(), g + ConstraintElement::n_guards(history));
}

void MeasureJoint::transition(int i, const LocalMotion &motion, double *history) const
{
  const int         of_law   = ConstraintElement::n_guards(history);
  double           *function = history + ConstraintElement::n_history();
  const std::string kink     = guards(history)[i].kind;
  if (i < of_law)
  {
    const PrescribedMotion before = prescribed(motion.t, history);
    ConstraintElement::transition(i, motion, history);
    const PrescribedMotion after = prescribed(motion.t, history);
    refuse_jump(kink, "the prescribed motion", before.value, after.value);
    refuse_jump(kink, "the speed of the prescribed motion", before.rate, after.rate);
    return;
  }
  const auto s = [&]
  {
    double G[CombinedMeasure::max_measures];
    return measure().evaluate(motion.u, motion.v, G, function).s;
  };
  const double value = s(), slope = measure().slope(motion.u, function);
  measure().transition(i - of_law, motion.u, motion.v, function);
  refuse_jump(kink, "the position function", 0., value - s());
  refuse_jump(kink, "the slope of the position function", slope, measure().slope(motion.u, function));
}

std::vector<Quantity> MeasureJoint::quantities() const
{
  std::vector<Quantity> quantities{{parameters_.name, parameters_.unit}};
  if (measure().has_function())
    quantities.push_back({"reaction", parameters_.reaction_unit});
  if (is_driven())
    quantities.push_back({"power", "W"});
  return quantities;
}

double MeasureJoint::quantity(int i, const LocalMotion &motion, const double *history) const
{
  if (!motion.lambda)
    return std::nan("");
  if (i == 0)
    return *motion.lambda;
  if (i == 1 && measure().has_function())
    return -*motion.lambda * measure().slope(motion.u, of_function(motion, history));
  return *motion.lambda * prescribed(motion.t, history).rate;
}

} // namespace gestell::mechanism
