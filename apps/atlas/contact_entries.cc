// Effect of contacts on methods that are accurate for linear systems.

#include "apps/atlas/atlas.h"
#include "apps/output/charts/chart.h"
#include "coupling/integration/events/motion.h"
#include "coupling/integration/propagation/force_rule.h"
#include "fem/values/number_text.h"
#include "mechanism/elements/clearance.h"

#include <algorithm>
#include <cmath>

namespace gestell::apps
{
namespace
{

using coupling::ForceRule;
using coupling::MethodOptions;
using coupling::options_of;

struct NamedMethod
{
  std::string   name;
  MethodOptions options;
};

NamedMethod bdf(int order)
{
  return {"BDF " + std::to_string(order), options_of("bdf", order)};
}

NamedMethod generalised_alpha(double rho_inf)
{
  return {"generalised alpha " + short_text(rho_inf), options_of("generalised-alpha").with("rho_inf", rho_inf)};
}

NamedMethod exact(ForceRule force, int order, const std::string &name)
{
  return {"exact, " + name, options_of("exact", order).with("force", force_rule_name(force))};
}

NamedMethod average_acceleration()
{
  return {"average acceleration", options_of("newmark")};
}

NamedMethod hht(double alpha)
{
  return {"HHT " + short_text(alpha), options_of("hht").with("alpha", alpha)};
}

/// 1 kg that flies between two elastic stops without loss.
coupling::Machine flying_mass(double gap, double omega_contact)
{
  coupling::MachineModel  model;
  const coupling::Measure u = {{model.add_slider("x0", {1., 0., 0.}, 1., "ground"), 1.}};

  mechanism::Clearance::Parameters stops;
  stops.gap       = gap;
  stops.stiffness = omega_contact * omega_contact;
  model.attach("stops", std::make_shared<mechanism::Clearance>(stops), {u});
  coupling::Machine machine(std::move(model));
  return machine;
}

constexpr int flight_steps = 4000; ///< some five hundred flights from stop to stop

/// Kinetic energy in flight relative to the start, step by step; it is kept from the last flight during a contact.
std::vector<double> flight_energy(const NamedMethod &method, double omega_contact_h, bool locate)
{
  constexpr double gap_in_steps = 3.7; // way from the middle to a stop at the first speed
  auto             machine      = flying_mass(gap_in_steps, omega_contact_h); // h = 1, first speed 1
  MethodOptions    options      = method.options;
  options.step                  = 1.;

  coupling::Motion motion(machine, coupling::make_integrator(machine, options));
  motion.begin(0., Eigen::VectorXd::Zero(1), Eigen::VectorXd::Ones(1), {locate, flight_steps});
  std::vector<double> energy{1.};
  motion.to_end(
      [&]
      {
        const coupling::Instant &now = motion.integrator().instant();
        energy.push_back(std::abs(now.q[0]) < gap_in_steps ? now.v[0] * now.v[0] : energy.back());
        return energy.back() < 1e6;
      });
  return energy;
}

Curve energy_curve(const std::string &name, const std::vector<double> &energy, int colour)
{
  Curve curve{name, {}, {}, colour};
  for (std::size_t k = 0; k < energy.size(); k += 1 + k / 60)
  {
    curve.add(double(k), energy[k]);
  }
  return curve;
}

} // namespace

AtlasEntry hard_contact()
{
  AtlasEntry entry{
      "hard-contact",
      "Hard contact: spurious energy gain and loss",
      "A mass flies between two elastic stops without dissipation, about seven steps from one to the other. Every "
      "method here is stable for the mass in flight and for the mass in contact. Yet a step across the change of "
      "stiffness does spurious work. With generalised alpha (0.9, at stiffer stops also 0.5), HHT -0.05 and average "
      "acceleration the mass gains speed, although their spectral radius is at most 1; BDF 2 loses the energy. With "
      "located events no method gains energy, but the shortened step at the end of a contact still has an error. The "
      "step must therefore resolve a contact, ω_c h < 0.3, whatever the spectral radius. Exact propagation with the "
      "average force does exactly the work that the contact stores, p (u_1 - u_0) = V_0 - V_1, for every stiffness; "
      "across a kink as exactly as the average is computed, in 128 pieces. Largest kinetic energy in flight over 4000 "
      "steps relative to the start, and that at the end (the motion is chaotic, so only orders of magnitude count):",
      {},
      {},
      {}};
  const std::vector<double>      omega_h = {0.3, 1., 3., 10., 30.};
  const std::vector<NamedMethod> methods = {
      average_acceleration(), hht(-0.05), generalised_alpha(0.9),
      generalised_alpha(0.5), bdf(2),     exact(ForceRule::average, 2, "average force")};
  entry.table = {{"method", "events"}};
  for (const double x : omega_h)
    entry.table[0].push_back("ω_c h = " + short_text(x));
  Chart chart{"Kinetic energy in flight, ω_c h = 3",
              "",
              {"step", 1., double(flight_steps), Scale::logarithmic},
              {"relative to the start", 1e-2, 1e3, Scale::logarithmic}};
  for (std::size_t m = 0; m < methods.size(); ++m)
    for (const bool locate : {false, true})
    {
      std::vector<std::string> row{methods[m].name, locate ? "located" : "not located"};
      double                   largest = 0.;
      for (const double x : omega_h)
      {
        const std::vector<double> energy = flight_energy(methods[m], x, locate);
        const double              most   = *std::max_element(energy.begin(), energy.end());
        largest                          = std::max(largest, most);
        row.push_back(short_text(most, 1) + " / " + short_text(energy.back(), 1));
        // Over a kink each of the 128 pieces misses its mean by up to 128^-2, some hundred times in the run.
        if (methods[m].options.method == "exact")
          entry.comparisons.push_back({"exact, average force, events " +
                                           std::string(locate ? "located" : "not located") +
                                           ", energy at omega_c h = " + short_text(x),
                                       1., energy.back(), locate ? 1e-9 : 0.02});
        if (x == 3. && !locate)
          chart.panels[0].curves.push_back(energy_curve(methods[m].name, energy, static_cast<int>(m)));
      }
      if (m < 3 && !locate) // 1: it grew
        entry.comparisons.push_back({methods[m].name + " gains energy (1: yes)", 1., largest > 1.05 ? 1. : 0., 0.});
      entry.table.push_back(row);
    }
  entry.figures.push_back({entry.id, chart_svg(chart)});
  return entry;
}

namespace
{

/// A forced oscillator in a play, which it leaves and meets some ten times.
coupling::Machine forced_in_play()
{
  coupling::MachineModel  model;
  const coupling::Measure u = {{model.add_slider("x0", {1., 0., 0.}, 1., "ground"), 1.}};
  model.add_linear("spring", u, {400., 2., 0., 0.}, "N"); // 20 rad/s, 5 %
  model.add_load("load", u, 0., {{15., 0.8, 0.3}}, "N");

  mechanism::Clearance::Parameters stops;
  stops.gap       = 1e-3;
  stops.stiffness = 1e4;
  model.attach("stops", std::make_shared<mechanism::Clearance>(stops), {u});
  coupling::Machine machine(std::move(model));
  return machine;
}

/// x, x'/20 at t = end.
Eigen::Vector2d state_at(const MethodOptions &method, double step, bool locate, double end)
{
  auto          machine    = forced_in_play();
  MethodOptions options    = method;
  options.step             = step;
  options.newton.tolerance = 1e-13;

  coupling::Motion motion(machine, coupling::make_integrator(machine, options));
  motion.begin(0., Eigen::VectorXd::Zero(1), Eigen::VectorXd::Zero(1), {locate, end});
  motion.to_end();
  return {motion.integrator().instant().q[0], motion.integrator().instant().v[0] / 20.};
}

/// Slope of ln(error) over ln(step).
double slope(const std::vector<double> &step, const std::vector<double> &error)
{
  double n = 0., x = 0., y = 0., xx = 0., xy = 0.;
  for (std::size_t i = 0; i < step.size(); ++i)
  {
    const double a = std::log(step[i]), b = std::log(error[i]);
    n += 1., x += a, y += b, xx += a * a, xy += a * b;
  }
  return (n * xy - x * y) / (n * xx - x * x);
}

/// Instants at which a method is compared, and the exact states there.
struct PlayTrial
{
  std::vector<double>          ends{0.4, 0.55, 0.7, 0.8, 0.95, 1.05, 1.2, 1.35, 1.5};
  std::vector<Eigen::Vector2d> truth{};

  PlayTrial()
  {
    for (const double end : ends)
      truth.push_back(state_at(exact(ForceRule::collocation, 8, "").options, 2e-4, true, end));
  }

  /// Root mean square over the ends.
  double error(const MethodOptions &method, double step, bool locate) const
  {
    double sum = 0.;
    for (std::size_t k = 0; k < ends.size(); ++k)
      sum += (state_at(method, step, locate, ends[k]) - truth[k]).squaredNorm();
    return std::sqrt(sum / double(ends.size()));
  }
};

/// Slope where the error is above 5e-15 m; below rounding speaks: 1e3 steps of a motion of 1e-3 m.
double seen_slope(const std::vector<double> &h, const std::vector<double> &error)
{
  std::vector<double> h_seen, seen;
  for (std::size_t i = 0; i < error.size(); ++i)
    if (error[i] > 5e-15)
      h_seen.push_back(h[i]), seen.push_back(error[i]);
  return slope(h_seen, seen);
}

} // namespace

AtlasEntry order_at_play()
{
  AtlasEntry entry{
      "order-at-play",
      "Order lost at play without events",
      "A forced oscillator in a clearance. If a step crosses the instant of contact, the kink of the force causes a "
      "local error of second order, whatever the order of the method. With located events and a restart there, the "
      "method keeps its order. Orders are slopes over the steps of the figure (irregular without events), predicted "
      "min(p, 2) and p; the error is the root mean square over nine instants.",
      {},
      {{"method", "order without events", "order with events", "error at the smallest step"}},
      {}};
  const std::vector<NamedMethod> cases = {bdf(2), bdf(4), exact(ForceRule::collocation, 4, "collocation 4"),
                                          exact(ForceRule::collocation, 6, "collocation 6")};
  const std::vector<double>      steps = {4e-3, 2e-3, 1e-3, 5e-4, 2.5e-4}; // twice as long for order 6
  const PlayTrial                trial;
  Chart                          chart{
      entry.title, "", {"step in s", 1e-4, 1e-2, Scale::logarithmic}, {"error in m", 1e-14, 1e-2, Scale::logarithmic}};
  for (std::size_t m = 0; m < cases.size(); ++m)
  {
    std::vector<std::string> row{cases[m].name};
    double                   last = 0.;
    for (const bool locate : {false, true})
    {
      const int           p      = cases[m].options.order;
      const double        longer = p == 6 ? 2. : 1.;
      std::vector<double> h, error;
      for (const double base_step : steps)
      {
        const double step = longer * base_step;
        h.push_back(step);
        error.push_back(trial.error(cases[m].options, step, locate));
      }
      chart.panels[0].curves.push_back({cases[m].name + (locate ? ", events" : ""), h, error, static_cast<int>(m),
                                        locate ? LineStyle::full : LineStyle::dashed});
      const double order = seen_slope(h, error);
      // Without events the error constant jumps with the position of the contact within its step: by half an order over
      // a factor of 16. With events only the approach to the asymptotic range remains, which is longer for order 6.
      entry.comparisons.push_back({cases[m].name + (locate ? ", order with events" : ", order without events"),
                                   double(locate ? p : std::min(p, 2)), order, locate ? (p == 6 ? 0.7 : 0.35) : 0.6});
      row.push_back(short_text(order, 3));
      last = error.back();
    }
    row.push_back(short_text(last, 2) + " m");
    entry.table.push_back(row);
  }
  entry.figures.push_back({entry.id, chart_svg(chart)});
  return entry;
}

namespace
{

/// n masses of 1 kg, each between elastic stops of its own.
coupling::Machine rattling_masses(int n, double gap, double omega_contact)
{
  coupling::MachineModel           model;
  mechanism::Clearance::Parameters stops;
  stops.gap       = gap;
  stops.stiffness = omega_contact * omega_contact;
  for (int i = 0; i < n; ++i)
  {
    const std::string       number = std::to_string(i);
    const coupling::Measure u      = {{model.add_slider("x" + number, {1., 0., 0.}, 1., "ground"), 1.}};
    model.attach("stops " + number, std::make_shared<mechanism::Clearance>(stops), {u});
  }
  coupling::Machine machine(std::move(model));
  return machine;
}

} // namespace

AtlasEntry chatter()
{
  AtlasEntry entry{
      "chatter",
      "Chatter: too many events",
      "Masses rattle next to each other, each between its own stops, and every impact is an event. At most 20 events "
      "are located within the length of a step; the rest of that step is one step without location. Such steps are "
      "counted in `summary.json`; they limit the work for any machine. Average acceleration, 60 steps:",
      {},
      {{"masses", "events per step", "steps without location", "largest number of parts of a step"}},
      {}};
  constexpr double gap = 1., omega_contact = 1.; // in steps, at the speed 1
  constexpr int    n_steps = 60;                 // two impacts of each mass and more
  for (const int n : {10, 30, 60})
  {
    auto          machine = rattling_masses(n, gap, omega_contact);
    MethodOptions options = average_acceleration().options;
    options.step          = 1.;

    coupling::Motion motion(machine, coupling::make_integrator(machine, options));
    motion.begin(0., Eigen::VectorXd::LinSpaced(n, -0.97, 0.97), Eigen::VectorXd::Ones(n), {true, n_steps});
    std::vector<double> times{0.};
    motion.to_end(
        [&]
        {
          times.push_back(motion.time());
          return true;
        });
    std::size_t most = 0;
    for (std::size_t i = 0, j = 0; j < times.size(); ++j)
    {
      while (times[j] - times[i] >= 1. - 1e-9)
        ++i;
      most = std::max(most, j - i);
    }
    // Within one step's length at most: one event of a count of 20, the step past the limit, 20 of the next.
    entry.comparisons.push_back(
        {std::to_string(n) + " masses, at most 42 parts of a step (1: yes)", 1., most <= 42 ? 1. : 0., 0.});
    entry.table.push_back({std::to_string(n), short_text(double(motion.driver().events().size()) / n_steps),
                           std::to_string(motion.chattering_steps()), std::to_string(most)});
  }
  return entry;
}

} // namespace gestell::apps
