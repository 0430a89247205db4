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
    : scene_(apps::read_scene(write_scene(machine, folder).string()))
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
  Told              told;
  const double      began = cpu_seconds();
  std::atomic<bool> stop  = false;
  try
  {
    coupling::Machine model   = apps::build_machine(scene_);
    const auto        signals = apps::scene_signals(scene_, model);
    const auto        look    = [&](double) { stop = cpu_seconds() - began > patience; };
    told.run                  = coupling::simulate(model, initial_, options, signals, look, &stop);
    told.slow                 = told.run.interrupted;
  }
  catch (const std::exception &refusal)
  {
    told.refused = refusal.what();
  }
  told.cpu_s = cpu_seconds() - began;
  return told;
}

} // namespace gestell::tests
