#include "coupling/integration/method.h"

#include "coupling/integration/bdf/bdf.h"
#include "coupling/integration/bdf/bdf_controlled.h"
#include "coupling/integration/newmark/newmark.h"
#include "coupling/integration/newmark/wilson.h"
#include "coupling/integration/propagation/modal_propagation.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace gestell::coupling
{

namespace
{

constexpr double finest      = 1e-13; ///< tolerances below are rounding
constexpr double newton_part = 1e-2;  ///< Newton's tolerance in units of that of the error

template <typename Value>
void require(bool valid, const std::string &method, const char *parameter, Value value, const char *needed)
{
  if (valid)
    return;
  std::ostringstream message;
  message << method << ": " << parameter << " is " << value << "; it must be " << needed;
  throw std::invalid_argument(message.str());
}

} // namespace

std::string method_name(const MethodOptions &o)
{
  std::ostringstream name;
  switch (o.method)
  {
  case Method::bdf:
    name << "BDF " << o.order;
    break;
  case Method::newmark:
    name << "Newmark " << o.beta << ", " << o.gamma;
    break;
  case Method::wilson:
    name << "Wilson theta " << o.theta;
    break;
  case Method::hht:
    name << "HHT " << o.alpha;
    break;
  case Method::generalised_alpha:
    name << "generalised alpha " << o.rho_inf;
    break;
  case Method::central_difference:
    name << "central differences";
    break;
  case Method::exact:
    name << "exact, ";
    if (o.force == ForceRule::average)
      name << "average force";
    else if (o.force == ForceRule::linear)
      name << "linear force";
    else
      name << "collocation " << o.order;
    break;
  }
  return name.str();
}

void check_method(const MethodOptions &o)
{
  const std::string name         = method_name(o);
  const bool        controllable = o.method == Method::bdf || o.method == Method::exact;
  require(o.step >= 0. && std::isfinite(o.step), name, "step [s]", o.step, "positive");
  require(o.tolerance >= 0. && o.tolerance < 1., name, "tolerance", o.tolerance, "between 0 and 1");
  require(o.tolerance == 0. || controllable, name, "tolerance", o.tolerance,
          "left out: only bdf and exact control their step; give a step");
  require(o.tolerance == 0. || o.tolerance >= finest, name, "tolerance", o.tolerance,
          "1e-13 or more: what lies below is rounding");
  require(o.tolerance > 0. || o.step > 0., name, "step [s]", o.step, "positive, or a tolerance be given");
  require(o.newton.tolerance >= finest && o.newton.tolerance < 1., name, "newton_tolerance", o.newton.tolerance,
          "1e-13 or more, below 1");
  switch (o.method)
  {
  case Method::bdf:
    require(o.order >= 1 && o.order <= 6, name, "order", o.order, "1 to 6");
    break;
  case Method::newmark:
    require(o.beta >= 0., name, "beta", o.beta, "zero or positive");
    require(o.gamma > 0., name, "gamma", o.gamma, "positive");
    break;
  case Method::wilson:
    require(o.theta >= 1., name, "theta", o.theta, "1 or more");
    break;
  case Method::hht:
    require(o.alpha >= -1. / 3. && o.alpha <= 0., name, "alpha", o.alpha, "between -1/3 and 0");
    break;
  case Method::generalised_alpha:
    require(o.rho_inf >= 0. && o.rho_inf <= 1., name, "rho_inf", o.rho_inf, "between 0 and 1");
    break;
  case Method::central_difference:
    break;
  case Method::exact:
    require(o.force != ForceRule::collocation || (o.order % 2 == 0 && o.order >= 2 && o.order <= 8), name, "order",
            o.order, "2, 4, 6 or 8");
    require(o.tolerance == 0. || o.force == ForceRule::collocation, name, "tolerance", o.tolerance,
            "left out: only collocation of the force controls its step");
    break;
  }
}

std::unique_ptr<TimeIntegrator> make_integrator(const SecondOrderSystem &system, const MethodOptions &o)
{
  check_method(o);
  switch (o.method)
  {
  case Method::bdf:
  {
    if (o.tolerance > 0.)
    {
      BdfControlled::Options options;
      options.tolerance    = o.tolerance;
      options.largest_step = o.step;
      options.max_order    = o.order;
      options.newton       = o.newton;
      return std::make_unique<BdfControlled>(system, options);
    }
    Bdf::Options options;
    options.order        = o.order;
    options.step         = o.step;
    options.max_halvings = o.max_halvings;
    options.newton       = o.newton;
    return std::make_unique<Bdf>(system, options);
  }
  case Method::exact:
  {
    ModalPropagation::Options options;
    options.force     = o.force;
    options.order     = o.order;
    options.step      = o.step;
    options.tolerance = o.tolerance;
    options.newton    = o.newton;
    if (o.tolerance > 0.)
      options.newton.tolerance = std::max(newton_part * o.tolerance, finest);
    else
      options.max_halvings = o.max_halvings;
    return std::make_unique<ModalPropagation>(system, options);
  }
  case Method::wilson:
  {
    Wilson::Options options;
    options.theta        = o.theta;
    options.step         = o.step;
    options.max_halvings = o.max_halvings;
    options.newton       = o.newton;
    return std::make_unique<Wilson>(system, options);
  }
  default:
  {
    Newmark::Options options = o.method == Method::hht                 ? Newmark::hht(o.alpha)
                               : o.method == Method::generalised_alpha ? Newmark::generalised_alpha(o.rho_inf)
                                                                       : Newmark::central_difference();
    if (o.method == Method::newmark)
    {
      options.beta  = o.beta;
      options.gamma = o.gamma;
    }
    options.step         = o.step;
    options.max_halvings = o.max_halvings;
    options.newton       = o.newton;
    return std::make_unique<Newmark>(system, options);
  }
  }
}

} // namespace gestell::coupling
