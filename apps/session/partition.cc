#include "apps/session/partition.h"

#include "apps/scene/build/build_measures.h"
#include "coupling/algebra/dense_modes.h"

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

/// Whether an output of the frame depends on internal DOFs: interfaces are not retained for it.
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

/// Takes from the rows R [n1 x f] what the row at i spans; its length before.
double take(Eigen::MatrixXd &R, Eigen::Index i)
{
  const double length = R.row(i).norm();
  if (length > 0.)
  {
    const Eigen::RowVectorXd e = R.row(i) / length;
    R -= (R * e.transpose()) * e;
  }
  return length;
}

/// Assigns the reason to coordinates that constrain rigid-body modes of the frame, see partition_of().
void hold_free_motions(const coupling::ReducedFrame &frame, Reasons &reasons, Partition &partition)
{
  partition.n_free = frame.n_rigid();
  if (partition.n_free == 0)
    return;
  const auto      modes = coupling::dense_modes(frame.C, frame.M, coupling::cancelled_by_reduction, partition.n_free);
  Eigen::MatrixXd R     = modes.V.topLeftCorner(frame.n_interface, partition.n_free);
  const double    most  = R.rowwise().norm().maxCoeff();
  const auto      rank  = [&](auto counts, auto act)
  {
    for (int found = 0;; ++found)
    {
      Eigen::Index best = -1;
      for (Eigen::Index i = 0; i < R.rows(); ++i)
        if (counts(int(i)) && (best < 0 || R.row(i).norm() > R.row(best).norm()))
          best = i;
      constexpr double no_rank = 1e-6; // of the largest row: digits of files
      if (best < 0 || take(R, best) <= no_rank * most)
        return found;
      act(int(best));
    }
  };
  partition.n_held_by_acted = rank([&](int i) { return !reasons.none(i); }, [](int) {});
  std::vector<int> holding;
  rank([](int) { return true; }, [&](int i) { holding.push_back(i); });
  for (const int i : holding)
    reasons.add(i, "holds", "a free motion (C22 would be singular)");
}

/// Inner coordinates without mass.
int massless_inside(const FrameRequest &frame)
{
  if (frame.source != FrameSource::matrices)
    return 0;
  const auto  interface = frame.matrices.interface_coordinates();
  const auto &M         = frame.matrices.M;
  int         n         = 0;
  for (int i = 0; i < M.rows(); ++i)
    n += M.coeff(i, i) == 0. && !std::binary_search(interface.begin(), interface.end(), i) ? 1 : 0;
  return n;
}

} // namespace

Partition partition_of(const Scene &scene, const coupling::Machine &machine,
                       const std::vector<coupling::Signal> &signals)
{
  const coupling::ReducedFrame *frame = machine.model().reduced_frame();
  if (!frame || !scene.reduction.reduces())
    throw std::invalid_argument(scene.file + ": the frame is not reduced, so it has no partition");
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
  partition.n2         = frame->n_full - frame->n_interface;
  partition.n_modes    = int(frame->omega0.size());
  partition.n_massless = massless_inside(scene.frame);
  hold_free_motions(*frame, reasons, partition);
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
