#include "mechanism/user_force.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace gestell::mechanism
{

UserForce::UserForce(UserLaw law, Along along) : functions_(std::move(law)), along_(along)
{
  if (!functions_.force)
    throw std::invalid_argument("user force: the function of the force is missing");
  if (functions_.events.empty() == bool(functions_.event_values))
    throw std::invalid_argument("user force: events need names and a function of their values; give both or none");
  if (functions_.state.empty() && (functions_.at_event || functions_.after_step))
    throw std::invalid_argument("user force: functions change the state, but there is none; give its initial values");
}

std::string UserForce::fault(double t) const
{
  const std::lock_guard lock(mutex_);
  return lost_ || fault_at_ > t ? fault_ : "";
}

void UserForce::call(const char *role, const UserFunction &function, Numbers x, double t, const double *state,
                     double *y, int n_y, Numbered numbered) const
{
  std::string fault;
  std::fill_n(y, n_y, std::numeric_limits<double>::quiet_NaN());
  if (!lost_)
    try
    {
      function(x, {state, n_state()}, y, n_y);
      if (numbered == Numbered::maybe || std::all_of(y, y + n_y, [](double number) { return std::isfinite(number); }))
        return;
      fault = "returned a value that is not a finite number";
    }
    catch (const std::exception &raised)
    {
      fault = raised.what();
    }
  std::fill_n(y, n_y, std::numeric_limits<double>::quiet_NaN());
  if (lost_)
    return;
  const std::lock_guard lock(mutex_);
  fault_    = std::string("its function '") + role + "' " + fault;
  fault_at_ = t;
  lost_     = numbered == Numbered::yes;
}

double UserForce::force_at(const double *x, const double *state) const
{
  double F;
  call("force", functions_.force, {x, 3}, x[0], state, &F, 1, Numbered::maybe);
  return F;
}

void UserForce::slopes_at(const double *x, const double *state, double *slopes) const
{
  if (functions_.derivative)
  {
    call("derivative", functions_.derivative, {x, 3}, x[0], state, slopes, 2, Numbered::maybe);
    return;
  }
  const double     way      = std::cbrt(std::numeric_limits<double>::epsilon());
  constexpr double smallest = 1e-3; // m, rad, per second: below, the motion of a machine is a deflection
  for (int i = 0; i < 2; ++i)
  {
    const double d     = way * std::max(std::abs(x[1 + i]), smallest);
    double       low[] = {x[0], x[1], x[2]}, high[] = {x[0], x[1], x[2]};
    low[1 + i] -= d;
    high[1 + i] += d;
    slopes[i] = (force_at(high, state) - force_at(low, state)) / (high[1 + i] - low[1 + i]);
  }
}

void UserForce::engaged(const double *u, double *K, double *D) const
{
  const double x[] = {0., *u, 0.};
  double       slopes[2];
  slopes_at(x, functions_.state.data(), slopes);
  *K = std::isfinite(slopes[0]) ? -slopes[0] : 0.; // a law without a value ends a run at its start, with a message
  *D = std::isfinite(slopes[1]) ? -slopes[1] : 0.;
}

/// The numbers of all events, armed or not.
void UserForce::values(const LocalMotion &motion, const double *history, double *g) const
{
  const double x[] = {motion.t, motion.u[0], motion.v[0]};
  if (n_events() > 0)
    call("event_values", functions_.event_values, {x, 3}, motion.t, history, g, n_events(), Numbered::yes);
}

void UserForce::start(const LocalMotion &motion, double *history) const
{
  std::copy(functions_.state.begin(), functions_.state.end(), history);
  std::fill_n(history + n_state(), n_events(), 0.);
  arm(motion, history);
}

/// Arms the events whose numbers are negative.
void UserForce::arm(const LocalMotion &motion, double *history) const
{
  double *armed = history + n_state();
  if (std::all_of(armed, armed + n_events(), [](double one) { return one != 0.; }))
    return;
  std::vector<double> g(functions_.events.size());
  values(motion, history, g.data());
  for (int i = 0; i < n_events(); ++i)
    if (g[std::size_t(i)] < 0.)
      armed[i] = 1.;
}

void UserForce::change(const char *role, const UserFunction &function, Numbers x, double t, double *history) const
{
  std::vector<double> next(functions_.state.size());
  call(role, function, x, t, history, next.data(), n_state(), Numbered::yes);
  std::copy(next.begin(), next.end(), history);
}

void UserForce::accept(const LocalMotion &motion, double *history) const
{
  const double x[] = {motion.t, motion.u[0], motion.v[0]};
  if (functions_.after_step)
    change("after_step", functions_.after_step, {x, 3}, motion.t, history);
  arm(motion, history);
}

std::vector<Guard> UserForce::guards(const double *) const
{
  std::vector<Guard> all;
  for (const std::string &event : functions_.events)
    all.push_back({event, Crossing::rising});
  return all;
}

void UserForce::guard_values(const LocalMotion &motion, const double *history, double *g) const
{
  values(motion, history, g);
  for (int i = 0; i < n_events(); ++i)
    if (history[n_state() + i] == 0.)
      g[i] = -1.;
}

void UserForce::transition(int i, const LocalMotion &motion, double *history) const
{
  const double x[]       = {double(i), motion.t, motion.u[0], motion.v[0]};
  history[n_state() + i] = 0.;
  if (functions_.at_event)
    change("at_event", functions_.at_event, {x, 4}, motion.t, history);
}

std::vector<Quantity> UserForce::quantities() const
{
  if (along_ == Along::angle)
    return {{"torque", "N m"}, {"angle", "rad"}, {"rate", "rad/s"}};
  return {{"force", "N"}, {"displacement", "m"}, {"rate", "m/s"}};
}

double UserForce::quantity(int i, const LocalMotion &motion, const double *history) const
{
  return i == 0 ? -resistance(motion, history) : i == 1 ? motion.u[0] : motion.v[0];
}

} // namespace gestell::mechanism
