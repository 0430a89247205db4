#include "coupling/reduction/parts/parted_frame.h"

#include "coupling/algebra/dense_modes.h"
#include "coupling/algebra/sparse_cholesky.h"
#include "coupling/reduction/mode_ratios.h"
#include "coupling/reduction/parts/condensed_part.h"
#include "coupling/reduction/parts/cut_frame.h"
#include "coupling/reduction/parts/part_file.h"
#include "coupling/reduction/parts/part_interface.h"
#include "coupling/reduction/projection.h"
#include "coupling/reduction/shapes/interface_statics.h"
#include "fem/mesh/memory_estimate.h"
#include "fem/values/available_memory.h"
#include "fem/values/number_text.h"
#include "fem/values/temporary_directory.h"
#include "fem/values/two_pi.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gestell::coupling
{

template <typename Archive, typename Matrix>
void exchange_matrix(Archive &archive, Matrix &A)
{
  std::array<Eigen::Index, 2> size{{A.rows(), A.cols()}};
  archive(size);
  A.resize(size[0], size[1]);
  archive.run(A.data(), std::size_t(A.size()));
}

template <typename Archive>
void exchange(Archive &archive, RecoveredPart &value)
{
  auto &[T, beyond, left_out] = value;
  exchange_matrix(archive, T);
  exchange_matrix(archive, beyond);
  exchange_matrix(archive, left_out);
}

template <typename Archive>
void exchange(Archive &archive, StaticPart &value)
{
  auto &[C, load] = value;
  exchange_matrix(archive, C);
  exchange_matrix(archive, load);
}

namespace
{

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Modes to retain of every part: at least as many as of the frame, and those below twice the frequency of interest.
PartModes modes_of_parts(const ReductionOptions &options)
{
  constexpr double reach       = 2.;
  constexpr int    least_modes = 40; // the fixed-interface modes of a part lie above as many of the frame
  return {std::max(least_modes, options.n_modes), reach * options.frequency};
}

bool has_measured_shapes(const fem::ModalRatios &ratios)
{
  return std::any_of(ratios.named.begin(), ratios.named.end(),
                     [](const fem::NamedRatio &one) { return one.shape.size() > 0; });
}

/// What is known of the frame at the interface, in the coordinates of the joined parts.
fem::FrameMatrices on_interface(const fem::FrameMatrices &frame, const PartInterface &interface, Index n)
{
  fem::FrameMatrices joined;
  const auto        &rows  = interface.coordinates();
  const auto         taken = [&](const MatrixXd &of)
  {
    MatrixXd result                    = MatrixXd::Zero(n, of.cols());
    result.topRows(Index(rows.size())) = of(rows, Eigen::all);
    return result;
  };
  joined.interfaces = frame.interfaces;
  for (fem::Interface &node : joined.interfaces)
    node.renumber([&](int i) { return interface.place(i); });
  if (!has_measured_shapes(frame.modal_damping_ratio)) // which need the displacements of the whole
    joined.modal_damping_ratio = frame.modal_damping_ratio;
  joined.translations      = taken(frame.translations);
  joined.rigid_motions     = taken(frame.rigid_motions);
  joined.acceleration_load = taken(frame.acceleration_load);
  joined.centre            = frame.centre;
  joined.facts             = frame.facts;
  joined.mass              = frame.mass;
  joined.n_cells           = frame.n_cells;
  joined.notes             = frame.notes;
  joined.statements        = frame.statements;
  for (const std::size_t k : force_outputs(frame.outputs))
  {
    joined.outputs.push_back(frame.outputs[k]);
    for (VectorXd *row : {&joined.outputs.back().on_q, &joined.outputs.back().on_v, &joined.outputs.back().on_a})
      *row = row->size() > 0 ? VectorXd(taken(*row)) : VectorXd::Zero(n);
  }
  return joined;
}

/// The parts in one set of coordinates, and what is needed to recover their fields.
struct Joined
{
  std::vector<std::string>      files;
  std::vector<std::vector<int>> places;         ///< of the interface and the modes of each part
  std::vector<double>           highest, sigma; ///< of each part: frequency of its modes [rad/s], CondensedPart::sigma
};

Joined condense_all(const CutFrame &cut, const PartsCall &call, const ReductionOptions &options,
                    const std::string &folder)
{
  Joined joined;
  joined.files.resize(cut.size());
  for_each_part<std::string>(
      cut, call, "", [&](int p) { return stored_part(cut.part(p), modes_of_parts(options), call.place, folder); },
      [&](int p, std::string file) { joined.files[p] = std::move(file); });
  return joined;
}

/// Adds CondensedPart::forces to those of the joined parts.
void add_forces(const MatrixXd &forces, const std::vector<std::size_t> &which, const std::vector<int> &places,
                std::vector<fem::FrameOutput> &outputs)
{
  const Index n = Index(places.size());
  for (std::size_t k = 0; k < which.size(); ++k)
  {
    const auto        own    = forces.col(Index(k));
    fem::FrameOutput &output = outputs[which[k]];
    output.on_q(places) += own.head(n);
    output.on_v(places) += own.segment(n, n);
    output.on_a(places) += own.segment(2 * n, n);
    output.under_acceleration += own.tail<3>();
  }
}

fem::FrameMatrices join(const CutFrame &cut, const fem::FrameMatrices &frame, const PartsCall &call, Joined &joined)
{
  const PartInterface &interface = cut.interface();
  std::vector<int>     first_modes;
  int                  n = interface.size();
  for (int p = 0; p < cut.size(); ++p)
  {
    const CondensedPart part = read_part(joined.files[p], PartContent::frequencies);
    const int           m    = int(part.omega.size());
    joined.places.push_back(interface.places(cut.coordinates(p), n, m));
    joined.highest.push_back(part.omega[m - 1]);
    joined.sigma.push_back(part.sigma);
    first_modes.push_back(n);
    n += m;
  }
  fem::FrameMatrices matrices = on_interface(frame, interface, n);
  JoinedSums         sums(interface, first_modes, n);
  for (int p = 0; p < cut.size(); ++p)
  {
    const CondensedPart part = read_part(joined.files[p], PartContent::sums);
    sums.add(part, joined.places[p]);
    matrices.acceleration_load(joined.places[p], Eigen::all) += part.load;
    add_forces(part.forces, cut.forces(p), joined.places[p], matrices.outputs);
  }
  sums.give(matrices, call.alpha, call.beta);
  return matrices;
}

/// Fields of the whole frame from those of the joined parts.
struct Recovered
{
  MatrixXd              T, beyond; // [n x k], [n x 3]
  std::vector<VectorXd> left_out;  // [p] q_1^T F q_1 of each part and mode
};

Recovered recover_all(const CutFrame &cut, const PartsCall &call, const Joined &joined, const ReducedModel &reduced,
                      const MatrixXd &modes, Index n)
{
  const MatrixXd &T = reduced.basis.T, &beyond = reduced.beyond;
  Recovered       all{MatrixXd::Zero(n, T.cols()), MatrixXd::Zero(n, beyond.cols()),
                std::vector<VectorXd>(std::size_t(cut.size()))};
  for_each_part<RecoveredPart>(
      cut, call, "fields of ",
      [&](int p)
      {
        const std::vector<int> &places = joined.places[p];
        return recover(cut.part(p), read_part(joined.files[p], PartContent::modes), T(places, Eigen::all),
                       beyond(places, Eigen::all), modes);
      },
      [&](int p, RecoveredPart of)
      {
        const std::vector<int> coordinates = cut.coordinates(p);
        all.T(coordinates, Eigen::all)     = of.T;
        if (beyond.cols() > 0)
          all.beyond(coordinates, Eigen::all) = of.beyond;
        all.left_out[p] = std::move(of.left_out);
      });
  return all;
}

/// Modes of the frame up to its frequency limit.
DenseModes modes_of_interest(const ReducedFrame &reduced)
{
  DenseModes  modes = dense_modes(reduced.C, reduced.M, cancelled_by_reduction, reduced.n_rigid());
  const Index count = (modes.omega.array() <= (1. + 1e-6) * two_pi * reduced.frequency_limit_hz).count();
  return {modes.omega.head(count), modes.V.leftCols(count), modes.growth.head(std::min(count, modes.growth.size()))};
}

/// First-order bound of the relative errors of frequencies, substructures.md (10), by the modes that parts leave out.
std::string statement_of(const DenseModes &modes, const Joined &joined, const Recovered &recovered,
                         const PartInterface &interface)
{
  double            worst = 0., known = 0.;
  const std::size_t n_parts = joined.files.size();
  for (Index j = 0; j < modes.omega.size(); ++j)
  {
    double error = 0.;
    for (std::size_t p = 0; p < n_parts; ++p)
    {
      const double ratio = modes.omega[j] / joined.highest[p];
      const double F     = recovered.left_out[p][j];
      error += ratio < 1.
                   ? 0.5 * (std::pow(modes.omega[j], 2) + joined.sigma[p]) * std::max(F, 0.) / (1. - ratio * ratio)
                   : INFINITY;
    }
    worst = std::max(worst, error);
    known = modes.omega[j] / two_pi;
  }
  std::string text = "parts: " + std::to_string(n_parts) + " parts with " + std::to_string(interface.size()) +
                     " interface DOFs; due to their reduction, frequencies up to " + rounded(known) +
                     " Hz are too high by ";
  return text + (std::isfinite(worst) ? percent(worst, 2) + " at most (first-order bound)"
                                      : "an unknown amount: use [reduction] frequency to retain more modes of parts");
}

/// The reduced frame in the coordinates of the whole.
ReducedModel completed(ReducedModel reduced, const fem::FrameMatrices &frame, Recovered recovered)
{
  ReductionBasis basis;
  basis.q1            = frame.interface_coordinates();
  basis.T             = std::move(recovered.T);
  basis.omega0        = reduced.basis.omega0;
  ReducedFrame &known = reduced.frame;
  ReducedFrame  whole = project(frame, basis, {std::move(known.M), std::move(known.B), std::move(known.C)},
                                frame.acceleration_load, recovered.beyond);
  known.M.swap(whole.M);
  known.B.swap(whole.B);
  known.C.swap(whole.C);
  known.translations_load = std::move(whole.translations_load);
  const auto forces       = force_outputs(frame.outputs);
  for (std::size_t k = 0; k < forces.size(); ++k)
    whole.outputs[forces[k]] = std::move(known.outputs[k]);
  known.outputs      = std::move(whole.outputs);
  known.points       = std::move(whole.points);
  known.triangles    = std::move(whole.triangles);
  known.displacement = std::move(whole.displacement);
  known.stress       = std::move(whole.stress);
  known.n_full       = whole.n_full;
  return {std::move(known), std::move(basis), std::move(recovered.beyond), std::move(reduced.factor)};
}

/// x <- C^-1 x
void solve_supported(const Eigen::SparseMatrix<double> &C, VectorXd &x, const PartsCall &call)
{
  constexpr double regular_pivots = 1e-13; // ratio of pivots: below it C is singular up to rounding
  try
  {
    const SparseCholesky factor(C, {}, fem::available_memory());
    if (factor.pivot_ratio() > regular_pivots)
      return factor.solve_in_place(x);
  }
  catch (const NotPositiveDefinite &)
  {
  }
  throw std::invalid_argument(call.prestress + ": the supports leave the frame free to move, so its loads have no "
                                               "static equilibrium; add a support");
}

/// Prestressed parts are stable with their interface fixed, and so must be the frame.
void require_stable(const Eigen::SparseMatrix<double> &C, const PartsCall &call)
{
  try
  {
    const SparseCholesky factor(C, {}, fem::available_memory());
  }
  catch (const NotPositiveDefinite &)
  {
    throw std::invalid_argument(call.prestress +
                                ": prestress beyond buckling: the frame buckles at less than 1 times these loads; "
                                "reduce them or their 'factor', or stiffen the frame");
  }
}

} // namespace

ReducedModel reduce_in_parts(const fem::FrameMatrices &frame, const fem::CellParts &parts,
                             const ReductionOptions &options, const PartsCall &call)
{
  const CutFrame cut(frame, parts, call);
  const int      n = int(frame.M.rows()), n1 = cut.interface().size();
  int            least = n; // DOFs within a part
  for (int p = 0; p < cut.size(); ++p)
    least = std::min(least, cut.interface().n_interior(p));
  if (n1 > n - n1 || least == 0)
    throw std::invalid_argument(call.place + ": parts = " + std::to_string(parts.size()) + " leaves " +
                                std::to_string(n - n1) + " DOFs within the parts and makes " + std::to_string(n1) +
                                " interface DOFs between them; use fewer parts, or parts = \"auto\"");
  const fem::TemporaryDirectory folder; // unless the cache takes the parts
  Joined                        joined   = condense_all(cut, call, options, folder.path().string());
  const fem::FrameMatrices      matrices = join(cut, frame, call, joined);
  if (!call.prestress.empty())
    require_stable(matrices.C, call);
  ReducedModel     reduced   = reduce_with_basis(matrices, options, call.progress);
  const DenseModes modes     = modes_of_interest(reduced.frame);
  Recovered        recovered = recover_all(cut, call, joined, reduced, modes.V, n);
  reduced.frame.statements.push_back(statement_of(modes, joined, recovered, cut.interface()));
  ReducedModel whole = completed(std::move(reduced), frame, std::move(recovered));
  if (has_measured_shapes(frame.modal_damping_ratio))
    add_modal_damping(whole.frame, frame.modal_damping_ratio);
  return whole;
}

VectorXd deflection_in_parts(const fem::FrameMatrices &frame, const fem::CellParts &parts, const VectorXd &f,
                             const PartsCall &call)
{
  PartsCall unstressed = call;
  unstressed.prestress.clear(); // C is not yet about these loads: a part that is not positive definite is free
  const CutFrame                cut(frame, parts, unstressed);
  const PartInterface          &interface = cut.interface();
  const int                     n1        = interface.size();
  std::vector<std::vector<int>> places;
  for (int p = 0; p < cut.size(); ++p)
    places.push_back(interface.places(cut.coordinates(p), n1, 0));
  JoinedSums sums(interface, std::vector<int>(std::size_t(cut.size()), n1), n1);
  VectorXd   q1 = f(interface.coordinates());
  for_each_part<StaticPart>(
      cut, call, "deflection of ", [&](int p) { return condense_statics(cut.part(p), f(cut.coordinates(p))); },
      [&](int p, StaticPart part)
      {
        CondensedPart own;
        own.C = std::move(part.C);
        own.M = MatrixXd::Zero(own.C.rows(), own.C.cols());
        sums.add(own, places[std::size_t(p)]);
        q1(places[std::size_t(p)]) += part.load;
      });
  fem::FrameMatrices joined;
  sums.give(joined, 0., 0.);
  solve_supported(joined.C, q1, call);

  VectorXd q = VectorXd::Zero(f.size());
  for_each_part<std::vector<double>>(
      cut, call, "fields of ",
      [&](int p)
      {
        const VectorXd own = recover_statics(cut.part(p), f(cut.coordinates(p)), q1(places[std::size_t(p)]));
        return std::vector<double>(own.begin(), own.end());
      },
      [&](int p, const std::vector<double> &own)
      { q(cut.coordinates(p)) = VectorXd::Map(own.data(), Index(own.size())); });
  return q;
}

PartsMemory memory_of_parts(const fem::CellParts &parts, const fem::FrameMatrices &frame, double compactness)
{
  const PartInterface interface(parts, frame.interface_coordinates());
  const double        libraries = fem::reduction_memory(0., compactness);
  // Measured for the press frame: 26 MB for 100 000 DOFs; and 60 columns of the basis.
  constexpr double bytes_per_coordinate = 260. + 60. * sizeof(double);
  // Of a part: C*, M*, S, a contribution and its sum in elimination.  Of the joined parts: C and M, both triangles with
  // row numbers, M once more in the order of the factor, the factor and its work space; measured.
  constexpr double bytes_per_pair = 5. * sizeof(double), bytes_per_joined_pair = 60.;
  constexpr double of_files = 0.1 * 1024. * 1024. * 1024.; // libraries that children do not touch
  const double     mesh     = bytes_per_coordinate * double(frame.M.rows());
  PartsMemory      memory;
  for (int p = 0; p < parts.size(); ++p)
  {
    const double n1 = interface.n_held(p);
    memory.part     = std::max(memory.part, mesh - of_files + bytes_per_pair * n1 * n1 +
                                                fem::reduction_memory(n1 + interface.n_interior(p), compactness));
  }
  memory.joined = libraries + mesh + bytes_per_joined_pair * common_pairs(interface);
  return memory;
}

} // namespace gestell::coupling
