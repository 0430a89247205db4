#include "tests/apps/session/sensitivity_comparison.h"

#include "apps/scene/build/build_machine.h"
#include "apps/scene/file/scene_file.h"
#include "apps/session/sensitivity/sensitivity_keys.h"
#include "apps/session/session.h"
#include "coupling/frame/frame_recipe.h"
#include "fem/values/number_text.h"
#include "tests/apps/session/differentiated.h"
#include "tests/support/test.h"

#include <random>

namespace gestell::tests
{
namespace
{

using apps::SensitivityOutput;
using apps::Session;
using apps::VariedKey;

using Values = std::map<std::string, double>;
using Runs   = std::vector<std::array<Values, 2>>; ///< with an entry less and more by h, 2 h, 4 h ...

constexpr double of_limit = 0.1; ///< what a difference may be off by itself

bool is_instant(const std::string &output)
{
  const std::string what = output.substr(output.rfind('.') + 1);
  return what == "t" || what == "t_min" || what == "t_max";
}

bool is_frequency(const std::string &output)
{
  return output.compare(0, 6, "modes.") == 0;
}

/// What a run tells, under the names that its derivatives have.
struct Told
{
  Values values;
  double end = 0.; ///< [s]

  explicit Told(const apps::Result &result)
      : end(result.run->rows[result.run->rows.size() - result.run->columns.size()])
  {
    for (const auto &signal : result.run->signals)
      for (const auto &[name, value] :
           {std::pair(".min", signal.min), std::pair(".max", signal.max), std::pair(".final", signal.final),
            std::pair(".t_min", signal.t_min), std::pair(".t_max", signal.t_max)})
        values[signal.name + name] = value;
    for (std::size_t i = 0; i < result.run->events.size(); ++i)
      values["events." + std::to_string(i + 1) + ".t"] = result.run->events[i].t;
    for (std::size_t i = 0; i < result.coupled_modes.size(); ++i)
      values["modes." + std::to_string(i + 1)] = result.coupled_modes[i].frequency_hz;
  }

  /// What an output is compared with.
  double scale(const std::string &output) const
  {
    if (is_frequency(output))
      return std::abs(values.at(output));
    if (is_instant(output))
      return end;
    const std::string signal = output.substr(0, output.rfind('.'));
    return std::max(std::abs(values.at(signal + ".min")), std::abs(values.at(signal + ".max")));
  }

  /// Whether it is the instant of an extreme that is zero but for rounding, or for where an event was located: the
  /// signal is zero over a stretch, and the instant is where these are largest.  A force of a contact of omega is told
  /// as omega 1e-12 s of its size where the contact ends, up to 1e-6.
  bool is_instant_of_zero(const std::string &output) const
  {
    const std::size_t point = output.rfind('.');
    const std::string what  = output.substr(point + 1);
    if (what != "t_min" && what != "t_max")
      return false;
    return std::abs(values.at(output.substr(0, point + 1) + what.substr(2))) <=
           1e-6 * scale(output.substr(0, point + 1) + "final");
  }

  /// Whether it depends on the motion behind the first event.
  bool crosses_events(const std::string &output) const
  {
    const auto first = values.find("events.1.t");
    if (first == values.end() || is_frequency(output) || output == "events.1.t")
      return false;
    const std::string signal = output.substr(0, output.rfind('.')), what = output.substr(output.rfind('.') + 1);
    const double      t = what == "t"                        ? values.at(output)
                          : what == "final"                  ? end
                          : what == "min" || what == "t_min" ? values.at(signal + ".t_min")
                                                             : values.at(signal + ".t_max");
    return t >= first->second;
  }
};

struct Difference
{
  double value = 0., off = std::numeric_limits<double>::infinity(); ///< |x| dy/dx and its error
};

/// (64 D(h) - 20 D(2 h) + D(4 h))/45 of the central differences D, and of all neighbours those that differ least.
///
/// Neighbours agree by chance, too, where runs scatter by delta: of some hundred outputs a few do, and are wrong by
/// some delta/h.  Delta is what means M(h) = (y(h) + y(-h))/2 - y(0) leave that no h^2, h^4, h^6 explains,
///
///     r = M(h) - 21/64 M(2 h) + 21/1024 M(4 h) - 1/4096 M(8 h),
///
/// whose deviation is 1.02 delta; that of the difference is 1.02 delta/h.
Difference converged_difference(const std::vector<std::array<double, 2>> &y, double own, double h)
{
  std::vector<double> central, mean, sixth;
  for (std::size_t i = 0; i < y.size(); ++i)
  {
    central.push_back((y[i][1] - y[i][0]) / (2. * h * std::exp2(double(i))));
    mean.push_back(0.5 * (y[i][0] + y[i][1]) - own);
  }
  for (std::size_t i = 0; i + 2 < central.size(); ++i)
    sixth.push_back((64. * central[i] - 20. * central[i + 1] + central[i + 2]) / 45.);
  Difference best;
  for (std::size_t i = 0; i + 1 < sixth.size(); ++i)
  {
    const double scatter = mean[i] - 21. / 64. * mean[i + 1] + 21. / 1024. * mean[i + 2] - mean[i + 3] / 4096.;
    const double off     = std::max(std::abs(sixth[i] - sixth[i + 1]), std::abs(scatter) / (h * std::exp2(double(i))));
    if (off < best.off)
      best = {sixth[i], off};
  }
  return best;
}

void add_numbers(const apps::SceneNode &table, const std::string &path, std::vector<std::string> &keys)
{
  for (const auto &[name, node] : table.entries)
    if (const std::string key = path + "." + apps::written_key(name); node.type == apps::SceneNode::Type::table)
      add_numbers(node, key, keys);
    else if (node.type != apps::SceneNode::Type::array && node.type != apps::SceneNode::Type::boolean)
      keys.push_back(key);
}

std::vector<std::string> with(std::vector<std::string> overrides, const VariedKey &key, double share)
{
  overrides.push_back(key.overridden(share * std::abs(key.reported.value) / key.step));
  return overrides;
}

/// Of a frame that is reduced.
std::string frame_of(const apps::Scene &scene)
{
  return apps::frame_path(scene) == apps::FramePath::reduce ? coupling::content_key(apps::frame_origin(scene).recipe)
                                                            : "";
}

/// Those that are numbers, matter, and move neither the end of the run nor a frame that is reduced, by their unit.
std::map<std::string, std::vector<VariedKey>> by_unit(const std::string &path, const ComparedScene &compared,
                                                      const apps::SceneNode          &root,
                                                      const std::vector<std::string> &names)
{
  const Session                                 own(path, compared.overrides);
  const std::string                             frame = frame_of(own.scene());
  std::map<std::string, std::vector<VariedKey>> found;
  for (const std::string &name : names)
    try
    {
      VariedKey     key = apps::varied_keys(root, name).front();
      const Session varied(path, with(compared.overrides, key, 1e-3));
      if (varied.scene().run.options.end == own.scene().run.options.end && frame_of(varied.scene()) == frame)
        found[key.reported.unit].push_back(std::move(key));
    }
    catch (const std::invalid_argument &) // no number, or an expression of others, or nothing depends on it
    {
    }
  return found;
}

/// Of parameters, and then of what stands at objects, one of each unit after the other.
std::vector<VariedKey> drawn_keys(const std::string &path, const ComparedScene &compared)
{
  const apps::SceneNode    root = apps::read_scene_file(path, compared.overrides);
  std::vector<std::string> parameters, objects;
  if (const apps::SceneNode *table = root.find("parameters"))
    add_numbers(*table, "parameters", parameters);
  for (const std::string name : {"element", "body", "joint", "switch"})
    if (const apps::SceneNode *table = root.find(name))
      add_numbers(*table, name, objects);
  std::mt19937           random(44);
  std::vector<VariedKey> drawn;
  for (std::vector<std::string> *names : {&parameters, &objects})
  {
    std::shuffle(names->begin(), names->end(), random);
    const auto  keys = by_unit(path, compared, root, *names);
    std::size_t most = 0;
    for (const auto &[unit, of_unit] : keys)
      most = std::max(most, of_unit.size());
    for (std::size_t i = 0; i < most; ++i)
      for (const auto &[unit, of_unit] : keys)
        if (i < of_unit.size() && drawn.size() < compared.n_keys)
          drawn.push_back(of_unit[i]);
  }
  return drawn;
}

Values varied_run(const std::string &path, const std::vector<std::string> &overrides)
{
  const apps::Result result = Session(path, overrides).run();
  return result.run->failure.empty() ? Told(result).values : Values();
}

Difference difference_of(const std::string &output, const Runs &runs, double own, double h)
{
  std::vector<std::array<double, 2>> y;
  for (const auto &[below, above] : runs)
    if (below.count(output) > 0 && above.count(output) > 0)
      y.push_back({below.at(output), above.at(output)});
    else // other events
      break;
  return converged_difference(y, own, h);
}

/// Of an output: `given` is |x| dy/dx.
void compare(const SensitivityOutput &output, const std::string &by, double given, const Difference &of,
             const Told &reported, Comparison &found)
{
  const double scale = reported.scale(output.output);
  if (!(scale > 0.))
    return;
  ++found.n;
  const bool        crosses = reported.crosses_events(output.output);
  const double      limit = crosses ? limit_events : limit_smooth, size = std::max(scale, std::abs(of.value));
  const bool        converged = of.off <= of_limit * limit * size;
  const std::string name      = output.output + " by " + by + (crosses ? ", behind events: " : ": ");
  if (!std::isfinite(given))
  {
    ++found.none;
    EXPECT_NE(output.note, "") << name;
    if (converged && std::abs(of.value) > limit * size && !reported.is_instant_of_zero(output.output))
      found.missing.push_back(name + short_text(of.value / size) + " +- " + short_text(of.off / size) + "; " +
                              output.note);
    return;
  }
  if (!converged)
    return;
  Comparison::Side &side = crosses ? found.events : found.smooth;
  const double      off  = std::abs(given - of.value) / size;
  ++side.converged;
  side.within += off <= limit ? 1 : 0;
  side.worst = std::max(side.worst, off);
  if (off > limit)
    found.beyond.push_back(name + short_text(off) + ", " + exact_text(given) + " for " + exact_text(of.value) + " +- " +
                           short_text(of.off) + " of " + short_text(size) + ' ' + output.unit);
}

void print(const std::string &scene, const Comparison &found)
{
  std::cout << "  | `" << scene << "` | " << found.n << " | " << found.none << " | ";
  for (const Comparison::Side &side : {found.smooth, found.events})
    std::cout << side.converged << " | " << side.within << " | " << short_text(side.worst, 2) << " | ";
  std::cout << found.beyond.size() << " | " << found.missing.size() << " |\n";
  for (const std::string &one : found.beyond)
    std::cout << "  beyond: " << one << '\n';
  for (const std::string &one : found.missing)
    std::cout << "  missing: " << one << '\n';
}

} // namespace

Comparison compared_with_differences(const ComparedScene &compared)
{
  const std::string path = std::string(GESTELL_SOURCE_DIR "/apps/scenes/") + compared.scene;
  const auto        keys = drawn_keys(path, compared);
  std::string       list;
  for (const VariedKey &key : keys)
    list += (list.empty() ? "" : ",") + key.reported.key;
  const apps::Result base = differentiated(Session(path, compared.overrides), list);
  const auto         all  = sensitivities_of(base);
  Comparison         found;
  EXPECT_EQ(all.failure, "") << compared.scene;
  if (!all.failure.empty())
    return found;
  std::cout << compared.scene << " by " << list << ": " << base.run->events.size() << " events, CPU time "
            << short_text(all.run_cpu_s) << " s of the run, " << short_text(all.cpu_s) << " s of " << all.steps
            << " steps of derivatives\n";
  for (const std::string &warning : base.warnings)
    std::cout << "  warning: " << warning << '\n';
  const Told reported(base);
  for (std::size_t k = 0; k < keys.size(); ++k)
  {
    Runs runs;
    for (int i = 0; i < compared.n_steps; ++i)
    {
      const double share = compared.h * std::exp2(double(i));
      runs.push_back({varied_run(path, with(compared.overrides, keys[k], -share)),
                      varied_run(path, with(compared.overrides, keys[k], share))});
    }
    for (const SensitivityOutput &output : all.outputs)
      compare(output, keys[k].reported.key, output.derivative[Eigen::Index(k)] * std::abs(keys[k].reported.value),
              difference_of(output.output, runs, reported.values.at(output.output), compared.h), reported, found);
  }
  print(compared.scene, found);
  return found;
}

} // namespace gestell::tests
