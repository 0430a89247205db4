#include "tests/random_machines/trial.h"

#include "tests/random_machines/dice.h"
#include "tests/random_machines/draft.h"

#include <algorithm>
#include <atomic>
#include <ctime>
#include <fstream>

namespace gestell::tests
{
namespace
{
double cpu_seconds()
{
  timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

/// Of a method that is stable at any step: what modes there are.
double fastest_mode(const coupling::Machine &machine, const coupling::InitialState &initial, double end)
{
  coupling::MethodOptions bdf;
  bdf.step                                = end / 1000.;
  double                         fastest  = 0.;
  const coupling::LinearSpectrum spectrum = coupling::linear_spectrum(machine, initial);
  const coupling::StabilityGuard guard(spectrum, bdf);
  for (const coupling::ModeAccuracy &mode : guard.modes())
    fastest = std::max(fastest, mode.mode.omega);
  return fastest;
}
} // namespace

int Told::column(const std::string &name) const
{
  const auto found = std::find(run.columns.begin(), run.columns.end(), name);
  return found == run.columns.end() ? -1 : int(found - run.columns.begin());
}

std::string whole_scene(const RandomMachine &machine)
{
  std::string text = machine.scene + "\n[run]\nmethod = \"bdf\"\ntolerance = 1e-8\nend = " + digits(machine.end) +
                     "\n\n[output]\nsignals = [";
  for (const std::string &signal : machine.signals)
    text += (text.back() == '[' ? "\"" : ", \"") + signal + "\"";
  return text + "]\n";
}

std::filesystem::path write_scene(const RandomMachine &machine, const std::filesystem::path &folder)
{
  std::filesystem::create_directories(folder);
  for (const auto &[name, content] : machine.files)
    std::ofstream(folder / name) << content;
  const auto path = folder / "scene.toml";
  std::ofstream(path) << whole_scene(machine);
  return path;
}

Trial::Trial(const RandomMachine &machine, const std::filesystem::path &folder)
    : Trial(apps::read_scene(write_scene(machine, folder).string()))
{
}

Trial::Trial(const apps::SceneNode &tree, const std::filesystem::path &folder)
    : Trial(apps::read_scene(tree, (folder / "scene.toml").string(), fem::Scripts::harmless))
{
}

Trial::Trial(apps::Scene scene) : scene_(std::move(scene))
{
  apps::check_scene(scene_);
  find_start();
}

void Trial::find_start()
{
  coupling::Machine model = apps::build_machine(scene_);
  initial_                = apps::initial_state(scene_, model);
  fastest_                = fastest_mode(model, initial_, scene_.run.options.end);
}

Trial Trial::perturbed(double change, std::uint64_t seed, bool start_too) const
{
  Trial      other = *this;
  Dice       dice(seed);
  const auto factor = [&] { return 1. + change * dice.between(-1., 1.); };
  for (apps::BodyRequest &body : other.scene_.bodies)
  {
    body.mass *= factor();
    const double of_inertia = factor();
    body.inertia *= of_inertia;
    body.tensor *= of_inertia;
  }
  for (auto *values : {&other.scene_.start.q, &other.scene_.start.v})
    for (apps::NamedValue &value : *values)
      value.value *= start_too ? factor() : 1.;
  other.find_start();
  return other;
}

Told Trial::run(const coupling::MethodOptions &method, int rows, double end) const
{
  coupling::RunOptions options = scene_.run.options;
  options.method               = method;
  options.end                  = end > 0. ? end : options.end;
  options.output_step          = options.end / rows;
  return computed(options);
}

Told Trial::forced(const coupling::MethodOptions &method, double steps) const
{
  coupling::RunOptions options = scene_.run.options;
  options.method               = method;
  options.end                  = std::ceil(steps) * method.step;
  options.output_step          = method.step;
  options.force_unstable       = true;
  return computed(options);
}

Told Trial::computed(const coupling::RunOptions &options) const
{
  Told              reported;
  const double      began = cpu_seconds();
  std::atomic<bool> stop  = false;
  try
  {
    coupling::Machine model   = apps::build_machine(scene_);
    const auto        signals = apps::scene_signals(scene_, model);
    const auto        look    = [&](double) { stop = cpu_seconds() - began > patience; };
    reported.run              = coupling::simulate(model, initial_, options, signals, look, &stop);
    reported.slow             = reported.run.interrupted;
  }
  catch (const std::exception &refusal)
  {
    reported.refused = refusal.what();
  }
  reported.cpu_s = cpu_seconds() - began;
  return reported;
}

Distance distance(const RandomMachine &machine, const Told &a, const Told &b)
{
  Distance  largest;
  const int rows = std::min(a.n_rows(), b.n_rows());
  for (const coupling::SignalSummary &signal : a.run.signals)
  {
    const int i = a.column(signal.name), j = b.column(signal.name);
    double    sum = 0., size = at_rest * size_of(machine, signal.name);
    for (int row = 0; row < rows; ++row)
    {
      sum += std::abs(a.at(row, i) - b.at(row, j));
      size = std::max(size, std::abs(a.at(row, i)));
    }
    const double value = size > 0. ? sum / (rows * size) : 0.;
    if (!(value <= largest.value))
      largest = {value, signal.name};
  }
  return largest;
}

} // namespace gestell::tests
