#include "coupling/substructures/joined_parts.h"

#include "coupling/algebra/dense_modes.h"
#include "coupling/frame/reduced_frame.h"
#include "coupling/substructures/joint_forces.h"
#include "coupling/substructures/part_union.h"
#include "coupling/substructures/require_joints.h"
#include "coupling/substructures/stress_of_parts.h"
#include "coupling/substructures/welded_coordinates.h"
#include "fem/values/number_text.h"
#include "fem/values/two_pi.h"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <vector>

namespace gestell::coupling
{

namespace
{

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Flexibility F of the modes left out, without the part that static shapes of the basis represent.
MatrixXd beside_shapes(const ReducedFrame &part)
{
  const Index    n_1 = part.n_interface, k = part.omega0.size() - part.n_fixed_modes;
  const MatrixXd M_1X = part.M.block(0, part.M.rows() - k, n_1, k);
  return part.left_out - M_1X * part.omega0.tail(k).cwiseAbs2().cwiseInverse().asDiagonal() * M_1X.transpose();
}

/// Estimate of the lowest frequency left out [rad/s]: that of the lowest static shape, which is slightly above the next
/// mode, or else the highest frequency kept.
double lowest_left_out(const ReducedFrame &part)
{
  const VectorXd &omega = part.omega0;
  const Index     m     = std::min<Index>(part.n_fixed_modes, omega.size());
  if (omega.size() > m)
    return omega.tail(omega.size() - m).minCoeff();
  return m > 0 ? omega[m - 1] : 0.;
}

bool keeps_all(const ReducedFrame &part)
{
  return part.M.rows() >= part.n_full;
}

/**
 * Relative error by which the frequencies of the joined frame are too high because parts keep only some of their
 * fixed-interface modes. To first order, a mode phi (phi^T M phi = 1) of frequency omega moves the interfaces of part i
 * by q_1. The modes left out, of frequencies omega_j >= omega_c and coupling masses m_j, lower omega by
 *
 *     d(omega)/omega = 1/2 sum omega^2 (m_j^T q_1)^2 / (omega_j^2 - omega^2) <= 1/2 omega^2 q_1^T F q_1 / (1 - r^2),
 *     F = sum m_j m_j^T / omega_j^2,   r = omega / omega_c.
 *
 * Static shapes X of the inertia in their place remove F and leave r^4 of it. omega_c is the highest frequency kept or
 * the lowest of the static shapes, which is slightly above the next mode. Above omega_c, and for parts without F, the
 * error is unknown: NaN.
 *
 * @param omega,  V  modes of the joined frame [p], [n_j x p].
 * @return          [p], >= 0.
 *
 * Source: docs/theory/substructures.md (6), (7).
 */
VectorXd errors_by_modes_left_out(const std::vector<ReducedFrame> &parts, const PartUnion &all, const MatrixXd &G,
                                  const VectorXd &omega, const MatrixXd &V)
{
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  VectorXd         errors  = VectorXd::Zero(omega.size());
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    const ReducedFrame &part = parts[i];
    if (keeps_all(part))
      continue;
    if (part.left_out.size() == 0)
      return VectorXd::Constant(omega.size(), unknown);
    const double   out = lowest_left_out(part);
    const MatrixXd q_1 = G.middleRows(all.first[i], part.n_interface) * V, rest = beside_shapes(part);
    for (Index j = 0; j < omega.size(); ++j)
    {
      const double   r_2  = std::pow(omega[j] / out, 2);
      const MatrixXd F    = rest + r_2 * r_2 * (part.left_out - rest);
      const double   less = 0.5 * omega[j] * omega[j] * q_1.col(j).dot(F * q_1.col(j)) / (1. - r_2);
      errors[j] += r_2 < 1. ? std::max(0., less) : unknown;
    }
  }
  return errors;
}

/// Interfaces that the frame keeps, in the coordinates of the joined frame.
std::vector<fem::Interface> kept(const FrameOfParts &frame, const PartUnion &parts, const std::vector<int> &column)
{
  const auto                  names = kept_interfaces(frame);
  std::vector<fem::Interface> interfaces;
  for (fem::Interface interface : parts.interfaces)
    if (std::find(names.begin(), names.end(), interface.name) != names.end())
    {
      interface.face = {}; // modes replace the fields of the joint
      interface.renumber([&](int i) { return column[std::size_t(i)]; });
      interfaces.push_back(std::move(interface));
    }
  return interfaces;
}

std::vector<fem::FrameOutput> outputs_of_parts(const PartUnion &parts, const MatrixXd &G)
{
  std::vector<fem::FrameOutput> outputs = parts.outputs;
  for (fem::FrameOutput &output : outputs)
    for (VectorXd *row : {&output.on_q, &output.on_v, &output.on_a})
      if (row->size() > 0)
        *row = (G.transpose() * *row).eval();
  return outputs;
}

/// Pictures of all parts in one.
fem::Picture picture_of(const std::vector<ReducedFrame> &parts, const PartUnion &all, const MatrixXd &G)
{
  fem::Picture picture;
  Index        rows = 0;
  for (const ReducedFrame &part : parts)
    rows += part.displacement.rows();
  MatrixXd displacement(rows, G.cols());
  rows = 0;
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    const ReducedFrame &part  = parts[i];
    const int           first = int(picture.points.size());
    for (auto triangle : part.triangles)
    {
      for (int &corner : triangle)
        corner += first;
      picture.triangles.push_back(triangle);
    }
    picture.points.insert(picture.points.end(), part.points.begin(), part.points.end());
    displacement.middleRows(rows, part.displacement.rows()) =
        part.displacement.cast<double>() * G.middleRows(all.first[i], part.M.rows());
    rows += part.displacement.rows();
  }
  picture.displacement = displacement.sparseView();
  return picture;
}

void append(std::vector<std::string> &texts, const std::string &part, const std::vector<std::string> &more)
{
  for (const std::string &text : more)
    texts.push_back(part + ": " + text);
}

/// Sizes, mass and texts of the whole.
ReducedFrame facts_of(const std::vector<ReducedFrame> &parts, const FrameOfParts &frame)
{
  ReducedFrame whole;
  whole.facts.rigid_energy = 0.;
  whole.frequency_limit_hz = INFINITY;
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    const ReducedFrame &part = parts[i];
    whole.n_full += part.n_full;
    whole.n_cells += part.n_cells;
    whole.mass += part.mass;
    whole.frequency_limit_hz = std::min(whole.frequency_limit_hz, part.frequency_limit_hz);
    whole.facts.parts.insert(whole.facts.parts.end(), part.facts.parts.begin(), part.facts.parts.end());
    whole.facts.whole.add(part.facts.whole);
    if (!(part.facts.rigid_energy <= whole.facts.rigid_energy) && !std::isnan(whole.facts.rigid_energy))
      whole.facts.rigid_energy = part.facts.rigid_energy; // unknown if that of one part is
    if (const auto &own = part.facts.buckling_factor)
      whole.facts.buckling_factor = std::min(whole.facts.buckling_factor.value_or(*own), *own);
    append(whole.notes, frame.parts[i].name, part.notes);
    append(whole.cache_notes, frame.parts[i].name, part.cache_notes);
    append(whole.statements, frame.parts[i].name, part.statements);
  }
  return whole;
}

void add_rods(ReducedFrame &whole, const FrameOfParts &frame, const PartUnion &parts)
{
  for (const FrameJoint &joint : frame.joints)
    if (joint.kind == JointKind::tie_rod)
    {
      const double mass = mass_of_rod(joint, parts);
      whole.mass += mass;
      whole.facts.parts.push_back({"tie rod " + joint.name, joint.rod.material, mass});
      for (const JointEnd &end : joint.between)
        whole.facts.whole.add({0.5 * mass, position_of(parts.at(end)), Eigen::Matrix3d::Zero()});
    }
}

std::string force_text(double newton)
{
  const auto unit = display_unit("N", std::abs(newton));
  return rounded(newton * unit.factor) + " " + unit.unit;
}

/// Adds statements on the clamping forces of joints, and warns of joints without any.
void tell_preloads(ReducedFrame &whole, const FrameOfParts &frame, const std::vector<JointPreload> &preloads)
{
  for (std::size_t j = 0; j < frame.joints.size(); ++j)
  {
    const FrameJoint &joint = frame.joints[j];
    if (joint.kind == JointKind::tie_rod)
      whole.statements.push_back("joint " + joint.name + ": the tie rod force is " + force_text(joint.rod.prestress) +
                                 " in the tightened frame at rest");
    if (!joint.closes())
      continue;
    const double pressed = preloads[j].pressed;
    if (pressed > 0.)
      whole.statements.push_back("joint " + joint.name + ": clamping force " + force_text(pressed) +
                                 " at rest, without weight");
    else
      whole.notes.push_back(
          joint.place + ": this joint has no clamping force at rest (normal force " + force_text(pressed) +
          " without weight); it opens under any tension, which a linear frame cannot model. Give a tie rod a "
          "prestress, reverse 'normal' if it points from the second part to the first, or make it a weld");
  }
}

/// The part that a motion of all coordinates moves most.
std::string moved_part(const VectorXd &motion, const std::vector<ReducedFrame> &parts, const FrameOfParts &frame,
                       const PartUnion &all)
{
  std::vector<double> energy;
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    const VectorXd own = motion.segment(all.first[i], parts[i].M.rows());
    energy.push_back(own.dot(parts[i].M * own));
  }
  return frame.parts[std::size_t(std::max_element(energy.begin(), energy.end()) - energy.begin())].name;
}

/// Refuses joints that let a part move freely relative to the others: a motion without energy, V^T M V = E, other than
/// a rigid motion of the whole.
void require_held_parts(const DenseModes &modes, const MatrixXd &M, const MatrixXd &rigid,
                        const std::function<std::string(const VectorXd &)> &part_moved_by, const std::string &place)
{
  constexpr double free_share = 1e-8; // of the highest frequency: motions without energy, up to rounding
  const Index      n_free     = (modes.omega.array() <= free_share * modes.omega.maxCoeff()).count();
  const MatrixXd   free       = modes.V.leftCols(n_free);
  const MatrixXd   rest = free - rigid * (rigid.transpose() * M * rigid).ldlt().solve(rigid.transpose() * M * free);
  constexpr double rest_share = 1e-3; // of the kinetic energy of such a motion that no rigid one of the whole has
  for (Index k = 0; k < n_free; ++k)
    if (rest.col(k).dot(M * rest.col(k)) > rest_share)
      throw std::invalid_argument(place + ": the joints leave part '" + part_moved_by(rest.col(k)) +
                                  "' free relative to the others; join it by a weld, or by bolts with stiffness in all "
                                  "directions and against rotation");
}

/// States the errors by the modes that parts leave out.
void tell_errors(ReducedFrame &whole, const VectorXd &omega, const VectorXd &errors)
{
  const double limit = whole.frequency_limit_hz;
  double       worst = 0., known = 0.;
  for (Index j = 0; j < omega.size() && omega[j] <= two_pi * limit && !std::isnan(errors[j]); ++j)
  {
    worst = std::max(worst, errors[j]);
    known = omega[j] / two_pi;
  }
  whole.statements.push_back("parts: due to their reduction, frequencies up to " + rounded(known) +
                             " Hz are too high by " + percent(worst) + " at most (first-order estimate)");
}

/// A with zeros at further entries of `other`: coordinates that only mass couples stay together, as modes and
/// interface.
Eigen::SparseMatrix<double> with_pattern(const MatrixXd &A, const MatrixXd &other)
{
  std::vector<Eigen::Triplet<double>> entries;
  for (Index j = 0; j < A.cols(); ++j)
    for (Index i = 0; i < A.rows(); ++i)
      if (A(i, j) != 0. || other(i, j) != 0.)
        entries.emplace_back(int(i), int(j), A(i, j));
  Eigen::SparseMatrix<double> sparse(A.rows(), A.cols());
  sparse.setFromTriplets(entries.begin(), entries.end());
  return sparse;
}

/// Matrices, loads and motions of the whole.
fem::FrameMatrices matrices_of(const FrameOfParts &frame, const PartUnion &parts, const SprungUnion &with_springs,
                               const WeldedCoordinates &welded, const Eigen::Vector3d &centre)
{
  const MatrixXd    &G = welded.G;
  const MatrixXd     M = G.transpose() * with_springs.M * G;
  fem::FrameMatrices whole;
  whole.M                   = M.sparseView();
  whole.B                   = MatrixXd(G.transpose() * with_springs.B * G).sparseView();
  whole.C                   = with_pattern(G.transpose() * with_springs.C * G, M);
  whole.acceleration_load   = G.transpose() * with_springs.load;
  whole.rigid_motions       = stayed(rigid_motions_of(parts, centre), welded);
  whole.translations        = whole.rigid_motions.leftCols(3);
  whole.centre              = {centre[0], centre[1], centre[2]};
  whole.modal_damping_ratio = frame.modal_damping_ratio;
  whole.interfaces          = kept(frame, parts, welded.kept);
  return whole;
}

} // namespace

JoinedParts join_parts(const std::vector<ReducedFrame> &parts, const FrameOfParts &frame)
{
  require_joints(frame);
  const PartUnion         all          = beside_each_other(parts);
  const SprungUnion       with_springs = sprung(frame, all);
  const WeldedCoordinates welded       = weld(frame, all, parts);
  JoinedParts             joined;
  joined.facts = facts_of(parts, frame);
  add_rods(joined.facts, frame, all);
  fem::FrameMatrices &whole = joined.matrices;
  whole                     = matrices_of(frame, all, with_springs, welded, joined.facts.facts.whole.centre);
  whole.picture             = picture_of(parts, all, welded.G);
  whole.stress              = stress_of_parts(parts, frame, all, welded.G);
  whole.mass                = joined.facts.mass;
  whole.n_cells             = joined.facts.n_cells;

  const DenseModes modes = dense_modes(whole.C, whole.M, cancelled_by_reduction);
  require_held_parts(
      modes, whole.M, whole.rigid_motions,
      [&](const VectorXd &motion) { return moved_part(welded.G * motion, parts, frame, all); }, frame.place);
  joined.left_out = errors_by_modes_left_out(parts, all, welded.G, modes.omega, modes.V);
  tell_errors(joined.facts, modes.omega, joined.left_out);
  joined.preloads = preloads_of(frame, all, with_springs, welded.G, whole.rigid_motions);
  tell_preloads(joined.facts, frame, joined.preloads);
  whole.outputs = outputs_of_parts(all, welded.G);
  for (std::size_t j = 0; j < frame.joints.size(); ++j)
    for (auto &force :
         forces_of(frame.joints[j], all, with_springs, with_springs.springs[j], welded.G, joined.preloads[j]))
      whole.outputs.push_back(std::move(force));
  return joined;
}

ReductionOptions joined_options(const FrameOfParts &frame, const JoinedParts &joined, ReductionOptions options)
{
  const int all   = int(joined.matrices.M.rows()) - int(joined.matrices.interface_coordinates().size());
  options.n_modes = frame.all_modes ? all : -1;
  return options;
}

ReducedFrame completed(ReducedFrame reduced, const JoinedParts &joined)
{
  const ReducedFrame &known  = joined.facts;
  const auto          free   = reduced.facts.free_motions;
  reduced.facts              = known.facts;
  reduced.facts.free_motions = free;
  reduced.n_full             = known.n_full;
  reduced.n_cells            = known.n_cells;
  reduced.mass               = known.mass;
  reduced.frequency_limit_hz = std::min(reduced.frequency_limit_hz, known.frequency_limit_hz);
  reduced.notes.insert(reduced.notes.begin(), known.notes.begin(), known.notes.end());
  reduced.cache_notes = known.cache_notes;
  reduced.statements.insert(reduced.statements.begin(), known.statements.begin(), known.statements.end());
  return reduced;
}

} // namespace gestell::coupling
