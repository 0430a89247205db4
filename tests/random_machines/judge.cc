#include "tests/random_machines/judge.h"

#include "tests/random_machines/guard_trial.h"
#include "tests/random_machines/history.h"
#include "tests/random_machines/trial.h"
#include "tests/random_machines/twin.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace gestell::tests
{
namespace
{

constexpr double too_open   = 0.1; ///< share of the energy exchanged: steps are too long for the motion
constexpr double affordable = 1.;  ///< [s] of CPU time for fixed steps, before they are divided by four
constexpr int    dense_rows = 20000, most_tries = 3;
constexpr int    twin_rows      = 500;   ///< in a run, of the judge that uses nothing of the program
constexpr double twin_tolerance = 1e-11; ///< far below those it judges, far above rounding
constexpr double few_steps      = 1e5;   ///< of order 2, which with a tenth of its tolerance takes three times as many

coupling::MethodOptions controlled(const std::string &method, int order, double tolerance)
{
  coupling::MethodOptions options;
  options.method    = method;
  options.order     = order;
  options.tolerance = tolerance;
  return options;
}

coupling::MethodOptions fixed(const std::string &method, int order)
{
  coupling::MethodOptions options;
  options.method = method;
  options.order  = order;
  return options;
}

/// That of a run and the twin's history, row by row of the latter, in the same sense.
Distance distance(const RandomMachine &machine, const Told &reported, const std::vector<double> &twin)
{
  Distance          largest;
  const auto       &signals = machine.twin->signals();
  const int         every   = dense_rows / twin_rows;
  const std::size_t n       = signals.size();
  for (std::size_t k = 0; k < n; ++k)
  {
    const int column = reported.column(signals[k]);
    double    sum = 0., size = at_rest * size_of(machine, signals[k]);
    for (int row = 0; row <= twin_rows; ++row)
    {
      const double value = twin[row * n + k];
      sum += std::abs(reported.at(row * every, column) - value);
      size = std::max(size, std::abs(value));
    }
    if (const double value = sum / (twin_rows * size); !(value <= largest.value))
      largest = {value, signals[k]};
  }
  return largest;
}

bool begins(const std::string &text, const std::string &words)
{
  return text.compare(0, words.size(), words) == 0;
}

/// The start lies inside the contact that is named; a pressure is below zero; of fixed steps the balance is open,
/// Newton failed, or events were more than are located.
bool has_cause(const RandomMachine &machine, const std::string &warning, const Told &reported, bool accurate)
{
  if (!accurate && begins(warning, "energy balance error"))
    return reported.run.energy.residual > 0.01 * reported.run.energy.exchanged;
  if (!accurate && begins(warning, "Newton's method failed"))
    return reported.run.work.rejected > 0;
  if (!accurate && begins(warning, "chatter"))
    return reported.run.work.chatter > 0;
  if (begins(warning, "switch "))
    return machine.scene.find("[switch.") != std::string::npos; // whether it is thrown is left to chance
  if (warning.find("the pressure in chamber") != std::string::npos)
    return std::any_of(reported.run.signals.begin(), reported.run.signals.end(),
                       [](const coupling::SignalSummary &signal)
                       { return signal.name.find(".pressure_") != std::string::npos && signal.min < 0.; });
  const std::string words = "the initial state penetrates the contact of \"";
  if (!begins(warning, words))
    return false;
  const std::string name = warning.substr(words.size(), warning.find('"', words.size()) - words.size());
  for (const ContactFact &contact : machine.contacts)
    if (contact.name == name)
      return contact.loses || reported.at(0, reported.column(name + ".force")) != 0.;
  return false;
}

/// A piston at the end of its stroke, of oil or of gas: its law ends there, which the run tells.
bool leaves_its_law(const Told &reported)
{
  return std::any_of(reported.run.findings.begin(), reported.run.findings.end(),
                     [](const coupling::Finding &finding)
                     { return finding.text.find("the end of its stroke") != std::string::npos; });
}

/// Of order 2 for a way of omega h in a step: (omega h)^3/4.5 <= tolerance omega h.  1e-7, or more where that would
/// take too many steps.
double tolerance_of_order_2(double way)
{
  return std::clamp(std::pow(way / few_steps, 2) / 4.5, 1e-7, 1e-2);
}

class Judge
{
public:
  Judge(const RandomMachine &machine, const std::filesystem::path &folder) : machine_(machine), trial_(machine, folder)
  {
  }

  Verdict verdict()
  {
    const Way reference = {"bdf 1e-8", controlled("bdf", 5, 1e-8)},
              exact     = {"exact 1e-8", controlled("exact", 4, 1e-8)},
              low_order = {"bdf to order 2", controlled("bdf", 2, tolerance_of_order_2(machine_.end * fastest()))};
    const Motion bdf    = computed(reference, true);
    if (leaves_law_)
      return verdict_; // of that machine no method knows more
    fixed_steps(bdf, reference, "bdf 2 fixed", fixed("bdf", 2));
    if (machine_.twin)
      compare_with_twin(bdf, reference);
    if (machine_.bdf_only && machine_.twin)
      return verdict_; // the twin is the other method, and order 2 takes long where play is
    if (machine_.bdf_only)
      compare(bdf, reference, computed(low_order, true), low_order);
    else if (machine_.jointed || machine_.accelerated)
      fixed_steps(bdf, reference, "generalised alpha fixed", fixed("generalised-alpha", 2));
    else
    {
      compare(bdf, reference, computed(exact, true), exact);
      if (machine_.wide)
        fixed_exact(bdf, reference);
    }
    if (machine_.linear && machine_.loadless)
      for (const Finding &finding : guard_findings(machine_, trial_, verdict_.cpu_s))
        find(finding);
    return verdict_;
  }

private:
  using Motion = std::optional<Told>;

  void find(const Finding &finding) { verdict_.findings.push_back(finding); }

  double fastest() const { return std::max(trial_.fastest(), 2. * M_PI / machine_.period); } ///< [rad/s]

  Told run(const coupling::MethodOptions &method, int rows)
  {
    Told reported = trial_.run(method, rows);
    verdict_.cpu_s += reported.cpu_s;
    return reported;
  }

  /// A run, judged by itself.  Empty if it failed.
  Motion computed(const Way &way, bool accurate)
  {
    const Told dense = run(way.method, dense_rows);
    last_cpu_s_      = dense.cpu_s;
    too_long_        = !accurate && dense.run.energy.residual > too_open * dense.run.energy.exchanged;
    if (too_long_ && may_be_too_long_)
      return {};
    if (!dense.refused.empty())
      find({"refused", way.name, dense.refused});
    if (dense.slow)
      find({"slow", way.name, "at t", dense.run.rows[(dense.n_rows() - 1) * dense.run.columns.size()], machine_.end});
    leaves_law_ = !dense.run.failure.empty() && leaves_its_law(dense);
    if (!dense.run.failure.empty() && !leaves_law_)
      find({"failed", way.name, dense.run.failure});
    if (!dense.complete())
      return {};
    for (const std::string &warning : coupling::texts_of(dense.run.findings))
      if (!has_cause(machine_, warning, dense, accurate))
        find({"warning", way.name, warning});
    for (const Finding &finding : judged(way, dense, accurate))
      find(finding);
    return dense;
  }

  /// A peak that no row shows may be too narrow for them.
  std::vector<Finding> judged(const Way &way, const Told &dense, bool accurate)
  {
    const Told                 summary = run(way.method, 1);
    const std::vector<Finding> found =
        History(machine_, way.name, dense, summary, accurate ? way.method.tolerance : 0.).judge();
    if (std::none_of(found.begin(), found.end(), [](const Finding &f) { return f.kind == beyond_history; }))
      return found;
    return History(machine_, way.name, run(way.method, 32 * dense_rows), summary, accurate ? way.method.tolerance : 0.)
        .judge();
  }

  /// Histories must agree as well as either agrees with itself at a tenth of its tolerance, and as well as the machine
  /// itself is known: to what a change of ten tolerances in its masses and its start makes.
  void compare(const Motion &a, const Way &way_a, const Motion &b, const Way &way_b)
  {
    if (!a || !b)
      return;
    const Distance apart = distance(machine_, *a, *b);
    if (apart.value < 1e-5)
      return;
    const double own = self_distance(*a, way_a) + self_distance(*b, way_b);
    // A jump at the instant of a row may count for it in one history alone.
    const double bound = 10. * own + 3. * sensitivity(*a, way_a) + 1e-5 + 1. / dense_rows;
    if (apart.value > bound && !verdict_.sensitive)
      find({"histories differ", way_a.name + " / " + way_b.name, apart.signal, apart.value, bound});
  }

  /// With the solution of the twin's equations, whose error is far smaller.
  void compare_with_twin(const Motion &motion, const Way &way)
  {
    if (!motion)
      return;
    const std::vector<double> twin = machine_.twin->history(machine_.end, twin_rows, twin_tolerance);
    if (twin.empty())
      return;
    const Distance apart = distance(machine_, *motion, twin);
    if (apart.value < 1e-5)
      return;
    const double bound = 10. * self_distance(*motion, way) + 3. * sensitivity(*motion, way) + 1e-5 + 1. / twin_rows;
    if (!(apart.value < bound) && !verdict_.sensitive)
      find({"differs from the twin", way.name, apart.signal, apart.value, bound});
  }

  /// Exact propagation with fixed steps, by one of its forces and orders.
  void fixed_exact(const Motion &reference, const Way &way)
  {
    coupling::MethodOptions method = fixed("exact", 4);
    const int               draw   = int(machine_.seed % 6);
    const std::string       force  = draw == 4 ? "average" : draw == 5 ? "linear" : "collocation";
    method.order                   = draw < 4 ? 2 + 2 * draw : 4;
    method.set("force", force);
    fixed_steps(reference, way, "exact fixed, " + force + (draw < 4 ? " of order " + std::to_string(method.order) : ""),
                method);
  }

  /// What a change of ten tolerances makes of the motion.
  double sensitivity(const Told &reported, const Way &way)
  {
    if (sensitivity_)
      return *sensitivity_;
    double largest = 0.;
    for (std::uint64_t draw = 1; draw <= 2; ++draw)
    {
      const Told other = trial_.perturbed(10. * way.method.tolerance, machine_.seed + draw, !machine_.closed_start)
                             .run(way.method, dense_rows);
      verdict_.cpu_s += other.cpu_s;
      if (other.complete())
        largest = std::max(largest, distance(machine_, reported, other).value);
    }
    verdict_.sensitive = largest > 0.01;
    sensitivity_       = largest;
    return largest;
  }

  double self_distance(const Told &reported, Way way)
  {
    way.method.tolerance /= 10.;
    const Told finer = run(way.method, dense_rows);
    if (finer.slow)
      return std::numeric_limits<double>::infinity(); // not known
    return finer.complete() ? distance(machine_, reported, finer).value : 0.;
  }

  /// A method with fixed steps, which are halved until the motion is that of the reference.
  void fixed_steps(const Motion &reference, const Way &way, const std::string &name, coupling::MethodOptions method)
  {
    const double steps = std::clamp(machine_.end * fastest() * 50. / (2. * M_PI), 2000., 20000.);
    method.step        = machine_.end / std::ceil(steps);
    Motion motion      = computed({name, method}, false);
    for (int tries = 0; tries < most_tries && too_long_; ++tries)
    {
      if (last_cpu_s_ > affordable)
        return; // not a method for that machine, and its user is told
      method.step /= 4.;
      may_be_too_long_ = tries + 1 < most_tries;
      motion           = computed({name, method}, false);
    }
    may_be_too_long_ = true;
    if (!motion || !reference)
      return;
    constexpr double      close = 1e-3;
    Distance              apart = distance(machine_, *motion, *reference);
    std::optional<double> change; ///< by the last halving
    for (int halvings = 0; halvings < 4 && apart.value > close && 2. * motion->cpu_s < patience; ++halvings)
    {
      method.step /= 2.;
      Told finer = run(method, dense_rows);
      if (finer.slow)
        break;
      if (!finer.complete())
      {
        find({"failed", name, finer.run.failure + finer.refused});
        return;
      }
      change = distance(machine_, finer, *motion).value;
      apart  = distance(machine_, finer, *reference);
      motion = std::move(finer);
    }
    if (apart.value < close || !change)
      return;
    const double bound = 10. * *change + 3. * sensitivity(*reference, way);
    if (apart.value > bound && !verdict_.sensitive)
      find({"histories differ", way.name + " / " + name, apart.signal, apart.value, bound});
  }

  const RandomMachine  &machine_;
  Trial                 trial_;
  Verdict               verdict_;
  std::optional<double> sensitivity_;             ///< once it is known
  bool                  too_long_        = false; ///< fixed steps of the last run: it lost the motion
  bool                  leaves_law_      = false; ///< of an element, at the end of the last run
  double                last_cpu_s_      = 0.;
  bool                  may_be_too_long_ = true; ///< then nothing else is judged, and shorter ones are tried
};

} // namespace

Verdict judge(const RandomMachine &machine, const std::filesystem::path &folder)
{
  try
  {
    return Judge(machine, folder).verdict();
  }
  catch (const std::exception &refusal)
  {
    return {{{"refused", "scene", refusal.what()}}};
  }
}

} // namespace gestell::tests
