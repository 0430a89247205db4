#include "coupling/reduction/parts/parted_frame.h"

#include "coupling/algebra/dense_modes.h"
#include "coupling/reduction/mode_ratios.h"
#include "coupling/reduction/parts/condensed_part.h"
#include "coupling/reduction/parts/part_file.h"
#include "coupling/reduction/parts/part_interface.h"
#include "coupling/reduction/projection.h"
#include "fem/mesh/memory_estimate.h"
#include "fem/process/side_by_side.h"
#include "fem/values/number_text.h"
#include "fem/values/temporary_directory.h"
#include "fem/values/two_pi.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <stdexcept>

namespace gestell::coupling
{

template <typename Archive>
void exchange(Archive &archive, RecoveredPart &value)
{
  auto &[T, beyond, left_out] = value;
  const auto one              = [&](auto &A)
  {
    std::array<Eigen::Index, 2> size{{A.rows(), A.cols()}};
    archive(size);
    A.resize(size[0], size[1]);
    archive.run(A.data(), std::size_t(A.size()));
  };
  one(T);
  one(beyond);
  one(left_out);
}

namespace
{

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Sparse = Eigen::SparseMatrix<double>;

/// A cut frame and the parts of its matrices.
class CutFrame
{
public:
  CutFrame(const fem::FrameMatrices &frame, const fem::CellParts &parts, double alpha, double beta)
      : frame_(frame), parts_(parts), interface_(parts, frame.interface_coordinates())
  {
    damping_ = frame.B;
    if (alpha > 0.)
      damping_ = Sparse(damping_ - alpha * frame.M);
    if (beta > 0.)
      damping_ = Sparse(damping_ - beta * frame.C);
  }

  int                  size() const { return parts_.size(); }
  std::vector<int>     coordinates(int p) const { return parts_.coordinates(p); }
  const PartInterface &interface() const { return interface_; }
  std::string          name(int p) const { return "part " + std::to_string(p + 1) + " of " + std::to_string(size()); }

  PartOfFrame part(int p) const
  {
    PartOfFrame part;
    part.sums      = sums(p);
    part.stiffness = [this, p] { return std::move(sums(p).C); };
    part.name      = name(p);
    part.damping   = interface_.share(damping_, p, part.sums.coordinates);
    part.held      = interface_.held(part.sums.coordinates);
    part.load      = frame_.acceleration_load(part.sums.coordinates, Eigen::all);
    return part;
  }

private:
  fem::PartMatrices sums(int p) const
  {
    fem::PartMatrices sums = parts_.matrices(p);
    for (const auto &[own, of_frame] : {std::pair(&sums.C, &frame_.C), std::pair(&sums.M, &frame_.M)})
      if (of_frame->nonZeros() > 0)
        *own = Sparse(*own + interface_.share(*of_frame, p, sums.coordinates));
    return sums;
  }

  const fem::FrameMatrices &frame_;
  const fem::CellParts     &parts_;
  PartInterface             interface_;
  Sparse                    damping_; // beside alpha M + beta C
};

/// Modes to retain of every part: at least as many as of the frame, and those below twice the frequency of interest.
PartModes modes_of_parts(const ReductionOptions &options)
{
  constexpr double reach       = 2.;
  constexpr int    least_modes = 40; // the fixed-interface modes of a part lie above as many of the frame
  return {std::max(least_modes, options.n_modes), reach * options.frequency};
}

/// Calls work(p) for every part in a process of its own, whose memory goes back to the system.
template <typename Value, typename Work, typename Take>
void for_each_part(const CutFrame &cut, const PartsCall &call, const std::string &phase, const Work &work,
                   const Take &take)
{
  std::mutex mutex;
  const int  at_once = fem::in_one_process() ? 1 : std::min(call.at_once, cut.size());
  fem::side_by_side(cut.size(), at_once, call.progress,
                    [&](int p, const Progress &progress)
                    {
                      fem::ChildTask task;
                      task.head                               = call.place;
                      task.phase                              = "start";
                      task.alone                              = !fem::in_one_process();
                      task.library                            = "the reduction";
                      task.way_out                            = "use more parts, or a larger mesh.size";
                      Value                             value = fem::in_child<Value>(task, progress,
                                                         [&](const Progress &report)
                                                         {
                                                           if (report)
                                                             report(phase + cut.name(p), -1.);
                                                           return work(p);
                                                         });
                      const std::lock_guard<std::mutex> alone(mutex);
                      take(p, std::move(value));
                    });
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
  known.outputs           = std::move(whole.outputs);
  known.points            = std::move(whole.points);
  known.triangles         = std::move(whole.triangles);
  known.displacement      = std::move(whole.displacement);
  known.stress            = std::move(whole.stress);
  known.n_full            = whole.n_full;
  return {std::move(known), std::move(basis), std::move(recovered.beyond), std::move(reduced.factor)};
}

} // namespace

ReducedModel reduce_in_parts(const fem::FrameMatrices &frame, const fem::CellParts &parts,
                             const ReductionOptions &options, const PartsCall &call)
{
  const CutFrame cut(frame, parts, call.alpha, call.beta);
  const int      n = int(frame.M.rows()), n1 = cut.interface().size();
  int            least = n; // DOFs within a part
  for (int p = 0; p < cut.size(); ++p)
    least = std::min(least, cut.interface().n_interior(p));
  if (n1 > n - n1 || least == 0)
    throw std::invalid_argument(call.place + ": parts = " + std::to_string(parts.size()) + " leaves " +
                                std::to_string(n - n1) + " DOFs within the parts and makes " + std::to_string(n1) +
                                " interface DOFs between them; use fewer parts, or parts = \"auto\"");
  const fem::TemporaryDirectory folder; // unless the cache takes the parts
  Joined                        joined    = condense_all(cut, call, options, folder.path().string());
  ReducedModel                  reduced   = reduce_with_basis(join(cut, frame, call, joined), options, call.progress);
  const DenseModes              modes     = modes_of_interest(reduced.frame);
  Recovered                     recovered = recover_all(cut, call, joined, reduced, modes.V, n);
  reduced.frame.statements.push_back(statement_of(modes, joined, recovered, cut.interface()));
  ReducedModel whole = completed(std::move(reduced), frame, std::move(recovered));
  if (has_measured_shapes(frame.modal_damping_ratio))
    add_modal_damping(whole.frame, frame.modal_damping_ratio);
  return whole;
}

PartsMemory memory_of_parts(const fem::CellParts &parts, const fem::FrameMatrices &frame, double compactness)
{
  const PartInterface interface(parts, frame.interface_coordinates());
  const double        libraries = fem::reduction_memory(0., compactness);
  // Measured for the press frame: 26 MB for 100 000 DOFs; and 60 columns of the basis.
  constexpr double bytes_per_coordinate = 260. + 60. * sizeof(double);
  // Of a part: S, M*, a contribution and its sum in elimination.  Of the joined parts: C and M, both triangles with row
  // numbers, M once more in the order of the factor, the factor and its work space; measured.
  constexpr double bytes_per_pair = 4. * sizeof(double), bytes_per_joined_pair = 60.;
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
