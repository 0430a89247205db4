#include "coupling/machine/dense_base.h"
#include "coupling/machine/machine.h"
#include "coupling/machine/machine_parts.h"
#include "coupling/machine/machine_system.h"
#include "fem/values/two_pi.h"

#include <cmath>
#include <sstream>

namespace gestell::coupling
{

namespace
{

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// w^T V as a measure of p.
Measure in_modes(const Measure &w, const MatrixXd &V)
{
  Measure result;
  if (w.empty())
    return result;
  VectorXd row = VectorXd::Zero(V.cols());
  for (const auto &[i, weight] : w)
    row += weight * V.row(i).transpose();
  for (Eigen::Index j = 0; j < row.size(); ++j)
    result.emplace_back(int(j), row[j]);
  return result;
}

std::vector<Measure> in_modes(const std::vector<Measure> &measures, const MatrixXd &V)
{
  std::vector<Measure> result;
  for (const Measure &w : measures)
    result.push_back(in_modes(w, V));
  return result;
}

Signal in_modes(Signal signal, const MatrixXd &V)
{
  for (Measure *w : {&signal.on_q, &signal.on_v, &signal.on_a})
    *w = in_modes(*w, V);
  return signal;
}

/// V^T A V, symmetric, of a product with A.
template <typename Times>
MatrixXd projected(const MatrixXd &V, const Times &times)
{
  MatrixXd AV(V.rows(), V.cols());
  VectorXd column(V.rows());
  for (Eigen::Index j = 0; j < V.cols(); ++j)
  {
    times(V.col(j), column);
    AV.col(j) = column;
  }
  const MatrixXd A = V.transpose() * AV;
  return 0.5 * (A + A.transpose());
}

Excitation in_modes(const Excitation &loads, const MatrixXd &V)
{
  const int      m = int(V.cols());
  Excitation     result(m);
  const VectorXd constant = V.transpose() * loads.constant();
  for (int j = 0; j < m; ++j)
    result.add_constant(j, constant[j]);
  for (const Excitation::Harmonic &harmonic : loads.harmonics())
    for (int j = 0; j < m; ++j)
    {
      double cosine = 0., sine = 0.;
      for (const Excitation::Entry &entry : harmonic.load)
      {
        cosine += V(entry.coordinate, j) * entry.cosine;
        sine += V(entry.coordinate, j) * entry.sine;
      }
      result.add_harmonic(j, harmonic.omega, cosine, sine);
    }
  return result;
}

std::vector<std::string> names_of(const VectorXd &omega)
{
  std::vector<std::string> names;
  for (Eigen::Index j = 0; j < omega.size(); ++j)
  {
    std::ostringstream name;
    name << "mode " << j + 1 << " of " << omega[j] / two_pi << " Hz";
    names.push_back(name.str());
  }
  return names;
}

} // namespace

std::unique_ptr<MachineParts> MachineParts::in_modes(const ModalCoordinates &modes) const
{
  const MatrixXd &V  = modes.V;
  const auto      of = [&](auto times)
  { return projected(V, [&](const VectorXd &x, VectorXd &y) { (*base.*times)(x, y); }); };
  auto other                    = std::make_unique<MachineParts>();
  other->superposed_frequencies = modes.omega;
  other->coordinate_names       = names_of(modes.omega);
  other->gravity                = gravity;
  other->loads                  = loads;
  other->measures               = measures;
  for (NamedMeasure &measure : other->measures)
    measure.measures = coupling::in_modes(measure.measures, V);
  other->elements = elements;
  for (ElementPlacement &placement : other->elements)
    placement.measures = coupling::in_modes(placement.measures, V);
  for (auto &[path, signal] : signals())
    other->known_signals.emplace(path, coupling::in_modes(signal, V));
  other->switch_requests = switch_requests;
  for (PlacedSwitch own : switches)
  {
    own.targets.clear(); // place_switches() finds them
    own.signal = coupling::in_modes(own.signal, V);
    other->switches.push_back(std::move(own));
  }
  MatrixXd damping = of(&LinearBase::damping_times);
  if (modes.diagonal_damping)
    damping = MatrixXd(damping.diagonal().asDiagonal());
  other->base = std::make_unique<DenseBase>(of(&LinearBase::mass_times), damping, of(&LinearBase::stiffness_times));
  other->excitation        = coupling::in_modes(excitation, V);
  other->translation_loads = V.transpose() * translation_loads;
  other->place_elements(int(V.cols()));
  other->place_switches();
  return other;
}

Machine Machine::in_modes(const ModalCoordinates &modes) const
{
  MachineModel model;
  model.parts_ = parts_->in_modes(modes);
  return Machine(std::move(model), Assembled{});
}

Machine::Machine(MachineModel model, Assembled)
    : model_(std::move(model)), parts_(model_.parts_.get()), system_(std::make_unique<MachineSystem>(*parts_))
{
}

const VectorXd &Machine::superposed_frequencies() const
{
  return parts_->superposed_frequencies;
}

const LinearBase &Machine::base() const
{
  return *parts_->base;
}

} // namespace gestell::coupling
