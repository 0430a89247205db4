#include "apps/analysis/comparison/shared_measures.h"

#include "coupling/modes/energy_shares.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace gestell::apps
{

namespace
{

/// Unit and gradient [n] of a measure.
struct Gradient
{
  std::string     unit;
  Eigen::VectorXd of_q;
};

using Gradients = std::map<std::string, Gradient>; // by path

Eigen::VectorXd dense(const coupling::Measure &u, int n)
{
  Eigen::VectorXd row = Eigen::VectorXd::Zero(n);
  for (const auto &[i, weight] : u)
    row[i] += weight;
  return row;
}

bool ends_with(const std::string &text, const std::string &end)
{
  return text.size() > end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

/// Displacements and angles that are linear in the coordinates; those of springs separately.
void add_linear(const coupling::Machine &machine, Gradients &motions, Gradients &of_elements)
{
  const coupling::MachineModel &model = machine.model();
  std::set<std::string>         springs;
  for (const coupling::LinearSpring &spring : coupling::linear_springs(model))
    springs.insert(spring.name + ".displacement");
  for (const std::string &path : model.signal_paths())
  {
    const coupling::Signal signal = model.signal(path, path);
    const bool             motion = signal.element < 0 && signal.load < 0 && signal.measure < 0 && signal.on_t == 0. &&
                        signal.on_v.empty() && signal.on_a.empty() && !signal.on_q.empty() && signal.offset == 0.;
    if (motion && (signal.unit == "m" || signal.unit == "rad"))
      (springs.count(path) > 0 ? of_elements : motions)[path] = {signal.unit, dense(signal.on_q, machine.size())};
  }
}

void add_measures(const MachineAt &at, Gradients &motions)
{
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(at.q.size());
  for (const std::string &path : at.machine->model().signal_paths())
    if (ends_with(path, ".value"))
    {
      const auto     &measure = at.machine->model().measure(path.substr(0, path.size() - 6));
      Eigen::VectorXd gradient;
      measure.evaluate(at.q, zero, &gradient);
      motions[path] = {measure.unit, gradient};
    }
}

/// The measures of nonlinear elements, by number.
void add_elements(const coupling::Machine &machine, Gradients &of_elements)
{
  for (const coupling::ElementPlacement &placement : machine.model().elements())
    for (std::size_t i = 0; i < placement.measures.size(); ++i)
      of_elements[placement.name + " measure " + std::to_string(i + 1)] = {
          "", dense(placement.measures[i], machine.size())};
}

std::vector<SharedMeasure> shared(const Gradients &a, const Gradients &b)
{
  std::vector<SharedMeasure> names;
  for (const auto &[path, own] : a)
    if (const auto his = b.find(path); his != b.end() && his->second.unit == own.unit)
      names.push_back({path, own.unit});
  return names;
}

std::string some_of(const Gradients &gradients)
{
  constexpr int most = 4; // keys of a line of text
  std::string   text;
  int           n = 0;
  for (const auto &[path, own] : gradients)
    if (++n <= most)
      text += (n > 1 ? ", " : "") + path;
  return gradients.empty() ? "none" : text + (n > most ? ", ..." : "");
}

std::vector<coupling::Mode> trusted_modes(const Result &result)
{
  std::vector<coupling::Mode> modes = result.coupled_modes;
  const double                limit = result.model.frequency_limit;
  if (!std::isnan(limit))
    modes.erase(std::remove_if(modes.begin(), modes.end(), [&](const auto &mode) { return mode.frequency_hz > limit; }),
                modes.end());
  return modes;
}

ComparedModes compared_modes(const Result &result, const std::vector<SharedMeasure> &measures,
                             const Gradients &gradients)
{
  ComparedModes compared{result.scene, trusted_modes(result), {}};
  compared.shapes.resize(Eigen::Index(measures.size()), Eigen::Index(compared.modes.size()));
  for (std::size_t k = 0; k < measures.size(); ++k)
    for (std::size_t j = 0; j < compared.modes.size(); ++j)
      compared.shapes(Eigen::Index(k), Eigen::Index(j)) =
          gradients.at(measures[k].path).of_q.dot(compared.modes[j].shape);
  return compared;
}

/// Removes measures that move in one machine only: for a planar model the motions normal to its plane.
void keep_moving(ComparedShapes &shapes)
{
  Eigen::Index kept = 0;
  for (Eigen::Index k = 0; k < shapes.match.mass.size(); ++k)
    if (shapes.match.mass[k] > 0.)
    {
      shapes.measures[std::size_t(kept)] = shapes.measures[std::size_t(k)];
      shapes.match.mass[kept]            = shapes.match.mass[k];
      shapes.a.shapes.row(kept)          = shapes.a.shapes.row(k).eval();
      shapes.b.shapes.row(kept)          = shapes.b.shapes.row(k).eval();
      ++kept;
    }
  shapes.measures.resize(std::size_t(kept));
  shapes.match.mass.conservativeResize(kept);
  shapes.a.shapes.conservativeResize(kept, Eigen::NoChange);
  shapes.b.shapes.conservativeResize(kept, Eigen::NoChange);
}

struct Told
{
  Gradients motions, of_elements;
};

Told told_by(const MachineAt &at)
{
  Told reported;
  add_linear(*at.machine, reported.motions, reported.of_elements);
  add_measures(at, reported.motions);
  add_elements(*at.machine, reported.of_elements);
  return reported;
}

} // namespace

std::optional<ComparedShapes> compared_shapes(const Result &a, const MachineAt &at_a, const Result &b,
                                              const MachineAt &at_b)
{
  const Told of_a = told_by(at_a), of_b = told_by(at_b);
  for (const auto part : {&Told::motions, &Told::of_elements})
  {
    ComparedShapes shapes;
    shapes.measures = shared(of_a.*part, of_b.*part);
    shapes.a        = compared_modes(a, shapes.measures, of_a.*part);
    shapes.b        = compared_modes(b, shapes.measures, of_b.*part);
    shapes.match    = coupling::compare_modes(shapes.a.shapes, shapes.b.shapes);
    keep_moving(shapes);
    if (!shapes.measures.empty())
      return shapes;
  }
  return {};
}

std::string nothing_shared(const Result &a, const MachineAt &at_a, const Result &b, const MachineAt &at_b)
{
  return "--compare: \"" + a.scene + "\" and \"" + b.scene +
         "\" have no body, interface or element of the same name, so their modes cannot be matched; the first has " +
         some_of(told_by(at_a).motions) + ", the second " + some_of(told_by(at_b).motions) +
         "; use the same name for corresponding objects";
}

} // namespace gestell::apps
