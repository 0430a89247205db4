#include "apps/session/partition.h"

#include "apps/scene/build/build_measures.h"

#include <algorithm>
#include <map>
#include <stdexcept>

namespace gestell::apps
{

namespace
{

/// Names by kind of reason, in the order of the kinds, for every coordinate.
class Reasons
{
public:
  explicit Reasons(int n) : names_(std::size_t(n)) {}

  void add(const coupling::Measure &measure, const std::string &kind, const std::string &name)
  {
    for (const auto &[coordinate, weight] : measure)
      if (weight != 0.)
        add(coordinate, kind, name);
  }
  void add(int coordinate, const std::string &kind, const std::string &name)
  {
    if (coordinate < 0 || coordinate >= int(names_.size()))
      return;
    auto &all = names_[std::size_t(coordinate)][kind];
    if (std::find(all.begin(), all.end(), name) == all.end())
      all.push_back(name);
  }

  std::vector<std::string> of(int coordinate) const
  {
    std::vector<std::string> texts;
    for (const auto &[kind, names] : names_[std::size_t(coordinate)])
    {
      std::string text = kind + ": ";
      for (std::size_t i = 0; i < names.size(); ++i)
        text += (i > 0 ? ", " : "") + names[i];
      texts.push_back(text);
    }
    return texts;
  }
  bool are_only(int coordinate, const std::string &kind) const
  {
    const auto &all = names_[std::size_t(coordinate)];
    return all.size() == 1 && all.begin()->first == kind;
  }
  bool none(int coordinate) const { return names_[std::size_t(coordinate)].empty(); }

private:
  std::vector<std::map<std::string, std::vector<std::string>>> names_;
};

const std::string reads = "read by";

/// Of an output of the frame, which the inside has too: its interfaces are not there for it.
bool reads_modes(const coupling::Measure &measure, const coupling::ReducedFrame &frame)
{
  const int n = int(frame.M.rows());
  return std::any_of(measure.begin(), measure.end(),
                     [&](const auto &term)
                     { return term.second != 0. && term.first >= frame.n_interface && term.first < n; });
}

/// Inertia on a marker moves all its coordinates.
void add_carried(const std::string &marker, const std::string &name, const coupling::ReducedFrame &frame,
                 Reasons &reasons)
{
  for (const fem::Interface &interface : frame.interfaces)
    if (marker == "frame." + interface.name)
      for (const int coordinate : interface.coordinate)
        reasons.add(coordinate, "carries", name);
}

void add_acting(const Scene &scene, const coupling::Machine &machine, Reasons &reasons)
{
  const coupling::MachineModel &model = machine.model();
  for (const coupling::ElementPlacement &placement : model.elements())
    for (const coupling::Measure &measure : placement.measures)
      reasons.add(measure, placement.element->ideal_joint() ? "joint" : "nonlinear", placement.name);
  for (const LinearRequest &linear : scene.linear)
    reasons.add(measure_of(linear.u, model), "linear", linear.name);
  for (const LoadRequest &load : scene.loads)
    reasons.add(measure_of(load.u, model), load.oscillations.empty() ? "constant load" : "excited", load.name);
}

} // namespace

Partition partition_of(const Scene &scene, const coupling::Machine &machine,
                       const std::vector<coupling::Signal> &signals)
{
  const coupling::ReducedFrame *frame = machine.model().reduced_frame();
  if (!frame || !scene.reduction.reduces())
    throw std::invalid_argument(scene.file + ": its frame is not reduced, and has no partition");
  Reasons reasons(frame->n_interface);
  add_acting(scene, machine, reasons);
  for (const BodyRequest &body : scene.bodies)
    add_carried(body.carrier, body.name, *frame, reasons);
  for (const PointMassRequest &mass : scene.point_masses)
    add_carried(mass.marker, mass.name, *frame, reasons);
  for (const coupling::Signal &signal : signals)
    for (const auto *measure : {&signal.on_q, &signal.on_v, &signal.on_a})
      if (!reads_modes(*measure, *frame))
        reasons.add(*measure, reads, signal.name);

  Partition partition;
  partition.n2      = frame->n_full - frame->n_interface;
  partition.n_modes = int(frame->omega0.size());
  partition.n_free  = frame->n_rigid();
  for (int i = 0; i < frame->n_interface; ++i)
    partition.rows.push_back({machine.coordinate_name(i), reasons.of(i)});
  for (const fem::Interface &interface : frame->interfaces)
  {
    int  n    = 0;
    bool idle = true, only_read = true;
    for (const int coordinate : interface.coordinate)
      if (coordinate >= 0)
      {
        ++n;
        idle      = idle && reasons.none(coordinate);
        only_read = only_read && (reasons.none(coordinate) || reasons.are_only(coordinate, reads));
      }
    if (idle)
      partition.superfluous.push_back({interface.name, n});
    else if (only_read)
      partition.only_read.push_back(interface.name);
  }
  return partition;
}

} // namespace gestell::apps
