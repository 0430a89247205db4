#include "coupling/machine/machine_parts.h"

#include "coupling/machine/dense_base.h"
#include "coupling/machine/own_mode_base.h"
#include "coupling/machine/sparse_base.h"

#include <algorithm>
#include <cmath>

namespace gestell::coupling
{

namespace
{
const char *const motion_names[] = {"ux", "uy", "uz", "rx", "ry", "rz"};

void add_to(Eigen::MatrixXd &dense, const std::vector<Eigen::Triplet<double>> &triplets)
{
  for (const auto &entry : triplets)
    dense(entry.row(), entry.col()) += entry.value();
}

/// [a 0; 0 0] + triplets, n x n.
Eigen::SparseMatrix<double> enlarged(const Eigen::SparseMatrix<double> &a, int n,
                                     const std::vector<Eigen::Triplet<double>> &triplets)
{
  Eigen::SparseMatrix<double> sum = a;
  sum.conservativeResize(n, n);
  if (triplets.empty())
    return sum;
  Eigen::SparseMatrix<double> added(n, n);
  added.setFromTriplets(triplets.begin(), triplets.end());
  return sum + added;
}
} // namespace

int MachineParts::add_coordinates(const std::string &body, const std::vector<std::string> &names)
{
  if (markers.count(body))
    throw std::invalid_argument("the name \"" + body + "\" is used twice; give each body a unique name");
  const int first = size();
  coordinate_names.insert(coordinate_names.end(), names.begin(), names.end());
  return first;
}

bool MachineParts::is_lag(const Measure &u) const
{
  return std::any_of(
      u.begin(), u.end(),
      [this](const auto &term)
      { return std::find(lag_coordinates.begin(), lag_coordinates.end(), term.first) != lag_coordinates.end(); });
}

void MachineParts::add_body(const Body &body)
{
  bodies.push_back(body);
  markers[body.name]   = body.marker;
  positions[body.name] = body.position;
}

void MachineParts::add_interfaces(const std::vector<fem::Interface> &interfaces)
{
  for (const fem::Interface &interface : interfaces)
  {
    Marker marker;
    marker.name = "frame." + interface.name;
    for (int i = 0; i < 6; ++i)
      if (interface.coordinate[i] >= 0)
        (i < 3 ? marker.translation[i] : marker.rotation[i - 3])
            .emplace_back(interface.coordinate[i], interface.sign[i]);
    positions[marker.name] = interface.position;
    markers[marker.name]   = marker;
  }
}

void MachineParts::add_dyad(Triplets &matrix, double factor, const Measure &w)
{
  if (factor != 0.)
    for (const auto &[i, wi] : w)
      for (const auto &[j, wj] : w)
        matrix.emplace_back(i, j, factor * wi * wj);
}

void MachineParts::add_loads(double mass, const std::array<Measure, 3> &translation)
{
  for (int d = 0; d < 3; ++d)
    acceleration_load[d] = acceleration_load[d] + mass * translation[d];
}

void MachineParts::add_mass(double mass, const std::array<Measure, 3> &translation)
{
  for (int d = 0; d < 3; ++d)
    add_dyad(M, mass, translation[d]);
  add_loads(mass, translation);
}

Vector3 MachineParts::position_of(const std::string &marker) const
{
  const auto found = positions.find(marker);
  return found == positions.end() ? Vector3{} : found->second;
}

bool MachineParts::moves_with_frame(const Marker &marker) const
{
  for (const auto &motion : {marker.translation, marker.rotation})
    for (const Measure &u : motion)
      for (const auto &term : u)
        if (term.first < n_frame)
          return true;
  return false;
}

void MachineParts::finish()
{
  const int n       = size();
  translation_loads = Eigen::MatrixXd::Zero(n, 3);
  // Number of coordinates of a mechanism without frame above which sparse matrices are cheaper: small with ideal
  // joints; without any, where nine dense matrices of the base system (M, B, C, their blocks and inputs) exceed 300 MB.
  // Below it functions that need dense matrices are available.
  constexpr int dense_jointed = 60, dense_mechanism = 2000;
  if (full)
    assemble_sparse(n);
  else if (!reduced && n > (has_joints() ? dense_jointed : dense_mechanism))
    assemble_mechanism(n);
  else
    assemble_dense(n);
  for (int d = 0; d < 3; ++d)
    for (const auto &[coordinate, value] : acceleration_load[d])
      translation_loads(coordinate, d) += value;

  const Eigen::VectorXd weight = translation_loads * Eigen::Map<const Eigen::Vector3d>(gravity.data());
  excitation                   = Excitation(n);
  for (int i = 0; i < n; ++i)
    excitation.add_constant(i, weight[i]);
  for (const auto &[coordinate, value] : constant_load)
    excitation.add_constant(coordinate, value);
  for (const Load &load : loads)
    for (const Oscillation &part : load.oscillations)
      for (const auto &[coordinate, value] : load.u)
        excitation.add_harmonic(coordinate, part.omega, value * part.amplitude * std::sin(part.phase),
                                value * part.amplitude * std::cos(part.phase));
  known_signals = signals(); // monitored signals must not be among them
  add_watches();
  place_elements(n);
  place_switches();
}

void MachineParts::assemble_dense(int n)
{
  Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(n, n), damping = mass, stiffness = mass;
  ModalRange      modal;
  if (reduced)
  {
    mass.topLeftCorner(n_frame, n_frame)      = reduced->M;
    damping.topLeftCorner(n_frame, n_frame)   = reduced->B;
    stiffness.topLeftCorner(n_frame, n_frame) = reduced->C;
    translation_loads.topRows(n_frame)        = reduced->translations_load;
    if (reduced->modal && !own_modes)
      modal = {n_interface, n_frame - n_interface};
  }
  add_to(mass, M);
  add_to(damping, B);
  add_to(stiffness, C);
  const auto is_mode = [&](int i) { return i >= n_interface && i < n_frame; };
  const auto fits    = [&](const Triplets &A)
  {
    return std::none_of(A.begin(), A.end(),
                        [&](const auto &entry) { return is_mode(entry.row()) || is_mode(entry.col()); });
  };
  if (own_modes && fits(M) && fits(B) && fits(C))
    base = std::make_unique<OwnModeBase>(mass, damping, stiffness, *own_modes,
                                         std::make_unique<DenseBase>(mass, damping, stiffness));
  else
    base = std::make_unique<DenseBase>(std::move(mass), std::move(damping), std::move(stiffness), modal);
}

void MachineParts::assemble_sparse(int n)
{
  if (full->acceleration_load.size() > 0)
    translation_loads.topRows(n_frame) = full->acceleration_load;
  else
    translation_loads.topRows(n_frame) = full->M * full->translations;
  fem::ModalDamping damping_operator = full->modal_damping;
  if (damping_operator.Z.cols() > 0)
  {
    damping_operator.Z.conservativeResize(n, Eigen::NoChange);
    damping_operator.Z.bottomRows(n - n_frame).setZero();
  }
  base = std::make_unique<SparseBase>(enlarged(full->M, n, M), enlarged(full->B, n, B), enlarged(full->C, n, C),
                                      std::move(damping_operator));
}

bool MachineParts::has_joints() const
{
  return std::any_of(elements.begin(), elements.end(),
                     [](const ElementPlacement &placement) { return placement.element->ideal_joint() != nullptr; });
}

/// Only bodies: a few numbers per row.
void MachineParts::assemble_mechanism(int n)
{
  const Eigen::SparseMatrix<double> zero(n, n);
  base = std::make_unique<SparseBase>(enlarged(zero, n, M), enlarged(zero, n, B), enlarged(zero, n, C));
}

void MachineParts::place_elements(int n)
{
  int                  n_measures = 0, n_history = 0, n_constraints = 0;
  Triplets             columns;
  std::vector<Measure> known_angles;
  placed.clear();
  joints.clear();
  joint_blocks.clear();
  angles.clear();
  force_blocks.clear();
  for (const ElementPlacement &placement : elements)
  {
    const int k = placement.element->n_measures();
    if (k > max_measures)
      throw std::invalid_argument("element \"" + placement.name + "\" has " + std::to_string(k) +
                                  " measures; at most " + std::to_string(max_measures) + " are provided for");
    int n_motions = k;
    while (n_motions > 0 && is_lag(placement.measures[n_motions - 1]))
      --n_motions;
    placed.push_back({placement.element.get(), n_measures, k, n_history, n_motions});
    placed.back().name = placement.name;
    if (const int n_c = mechanism::n_constraints(*placement.element); n_c > 0)
    {
      placed.back().first_constraint = placed.back().first_multiplier = n_constraints;
      joints.push_back(int(placed.size()) - 1);
      joint_blocks.push_back({n_constraints, n_c, n_measures, k, placement.element->size_of_terms()});
      n_constraints += n_c;
      const auto own = placed.back().joint->angles();
      for (int body = 0; body < 2; ++body)
        if (own[body] >= 0)
        {
          const Measure &phi   = placement.measures[own[body]];
          auto           found = std::find(known_angles.begin(), known_angles.end(), phi);
          if (found == known_angles.end())
          {
            angles.push_back(n_measures + own[body]);
            found = known_angles.insert(found, phi);
          }
          placed.back().angles[body]       = 1 + int(found - known_angles.begin());
          placed.back().angles_of_it[body] = n_measures + own[body];
        }
    }
    else
    {
      force_blocks.push_back({n_measures, k, placement.element->size_of_terms()});
      if (placement.joint >= 0)
        placed.back().first_multiplier = placed[placement.joint].first_constraint;
    }
    for (int j = 0; j < k; ++j)
      for (const auto &[coordinate, weight] : placement.measures[j])
        columns.emplace_back(coordinate, n_measures + j, weight);
    n_measures += k;
    n_history += mechanism::n_history(*placement.element);
    if (placement.joint >= 0 && k == 1 && mechanism::n_history(*placement.element) > 0)
    {
      placed.back().stop = n_history;
      n_history += 2;
    }
  }
  W.resize(n, n_measures);
  W.setFromTriplets(columns.begin(), columns.end());
  history = Eigen::VectorXd::Zero(n_history);
}

void MachineParts::refresh_guards()
{
  guards.clear();
  held.clear();
  for (std::size_t e = 0; e < placed.size(); ++e)
  {
    double rate     = 0.;
    placed[e].holds = placed[e].sticks(history_of(placed[e]), rate) && !is_stopped(placed[e]);
    if (placed[e].holds)
      held.push_back({placed[e].first_measure, rate});
    if (!placed[e].branches || is_stopped(placed[e]))
      continue;
    const auto own = placed[e].branches->guards(history_of(placed[e]));
    for (std::size_t i = 0; i < own.size(); ++i)
    {
      const bool rising = own[i].crossing == mechanism::Crossing::rising;
      guards.push_back({static_cast<int>(e),
                        static_cast<int>(i),
                        rising ? GuardCrossing::rising : GuardCrossing::falling,
                        {elements[e].name, own[i].kind}});
    }
  }
  find_held_too();
  for (std::size_t i = 0; i < switches.size(); ++i)
    if (is_active(switches[i]))
      guards.push_back({-1,
                        static_cast<int>(i),
                        switch_crossing(switches[i]),
                        {switches[i].request.name, switch_event(switches[i])}});
}

std::string MachineParts::coordinate_name(int i) const
{
  if (i >= n_frame)
    return coordinate_names[i - n_frame];
  const std::vector<fem::Interface> &interfaces = reduced ? reduced->interfaces : full->interfaces;
  for (const fem::Interface &interface : interfaces)
    for (int m = 0; m < 6; ++m)
      if (interface.coordinate[m] == i)
        return "frame." + interface.name + "." + motion_names[m];
  return reduced && reduced->modal ? "frame mode " + std::to_string(i - n_interface + 1)
                                   : "frame coordinate " + std::to_string(i);
}

} // namespace gestell::coupling
