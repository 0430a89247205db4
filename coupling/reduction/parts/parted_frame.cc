#include "coupling/reduction/parts/parted_frame.h"

#include "coupling/algebra/dense_modes.h"
#include "coupling/reduction/parts/condensed_part.h"
#include "coupling/reduction/parts/part_interface.h"
#include "coupling/reduction/projection.h"
#include "fem/mesh/memory_estimate.h"
#include "fem/values/number_text.h"
#include "fem/values/two_pi.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gestell::coupling
{

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
std::vector<int> numbers_of_modes(const CutFrame &cut, const ReductionOptions &options)
{
  constexpr double reach       = 2.;
  constexpr int    least_modes = 40; // the fixed-interface modes of a part lie above as many of the frame
  std::vector<int> numbers;
  for (int p = 0; p < cut.size(); ++p)
  {
    int n = std::max(least_modes, options.n_modes);
    if (options.frequency > 0.)
      n = std::max(n, modes_below(cut.part(p), reach * two_pi * options.frequency) + 1);
    numbers.push_back(std::min(n, cut.interface().n_interior(p)));
  }
  return numbers;
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
  joined.modal_damping_ratio = frame.modal_damping_ratio;
  joined.translations        = taken(frame.translations);
  joined.rigid_motions       = taken(frame.rigid_motions);
  joined.acceleration_load   = taken(frame.acceleration_load);
  joined.centre              = frame.centre;
  joined.facts               = frame.facts;
  joined.mass                = frame.mass;
  joined.n_cells             = frame.n_cells;
  joined.notes               = frame.notes;
  joined.statements          = frame.statements;
  return joined;
}

/// The parts in one set of coordinates, and what is needed to recover their fields.
struct Joined
{
  fem::FrameMatrices         matrices;
  std::vector<CondensedPart> parts; ///< without C and M
  std::vector<int>           modes; ///< first coordinate of the modes of each part
};

Joined join(const CutFrame &cut, const fem::FrameMatrices &frame, double alpha, double beta,
            const ReductionOptions &options, const Progress &progress)
{
  const PartInterface   &interface = cut.interface();
  const std::vector<int> numbers   = numbers_of_modes(cut, options);
  Joined                 joined;
  int                    n = interface.size();
  for (const int m : numbers)
  {
    joined.modes.push_back(n);
    n += m;
  }
  joined.matrices = on_interface(frame, interface, n);
  JoinedSums sums(interface, joined.modes, n);
  for (int p = 0; p < cut.size(); ++p)
  {
    if (progress)
      progress(cut.name(p), double(p) / cut.size());
    PartOfFrame   part      = cut.part(p);
    const auto    places    = interface.places(part, joined.modes[p], numbers[p]);
    CondensedPart condensed = condense(std::move(part), numbers[p]);
    sums.add(condensed, places);
    joined.matrices.acceleration_load(places, Eigen::all) += condensed.load;
    condensed.C.resize(0, 0);
    condensed.M.resize(0, 0);
    joined.parts.push_back(std::move(condensed));
  }
  sums.give(joined.matrices, alpha, beta);
  return joined;
}

/// Fields of the whole frame from those of the joined parts.
struct Recovered
{
  MatrixXd              T, beyond; // [n x k], [n x 3]
  std::vector<VectorXd> left_out;  // [p] q_1^T F q_1 of each part and mode
};

Recovered recover_all(const CutFrame &cut, const Joined &joined, const ReducedModel &reduced, const MatrixXd &modes,
                      Index n, const Progress &progress)
{
  const MatrixXd &T = reduced.basis.T, &beyond = reduced.beyond;
  Recovered       all{MatrixXd::Zero(n, T.cols()), MatrixXd::Zero(n, beyond.cols()), {}};
  for (int p = 0; p < cut.size(); ++p)
  {
    if (progress)
      progress("fields of " + cut.name(p), double(p) / cut.size());
    PartOfFrame            part        = cut.part(p);
    const std::vector<int> coordinates = part.sums.coordinates;
    const auto             places = cut.interface().places(part, joined.modes[p], int(joined.parts[p].omega.size()));
    RecoveredPart          of =
        recover(std::move(part), joined.parts[p], T(places, Eigen::all), beyond(places, Eigen::all), modes);
    all.T(coordinates, Eigen::all) = of.T;
    if (beyond.cols() > 0)
      all.beyond(coordinates, Eigen::all) = of.beyond;
    all.left_out.push_back(std::move(of.left_out));
  }
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
  double worst = 0., known = 0.;
  for (Index j = 0; j < modes.omega.size(); ++j)
  {
    double error = 0.;
    for (std::size_t p = 0; p < joined.parts.size(); ++p)
    {
      const CondensedPart &part  = joined.parts[p];
      const double         ratio = modes.omega[j] / part.omega.tail<1>()[0];
      const double         F     = recovered.left_out[p][j];
      error += ratio < 1. ? 0.5 * (std::pow(modes.omega[j], 2) + part.sigma) * std::max(F, 0.) / (1. - ratio * ratio)
                          : INFINITY;
    }
    worst = std::max(worst, error);
    known = modes.omega[j] / two_pi;
  }
  std::string text =
      "parts: " + std::to_string(joined.parts.size()) + " parts with " + std::to_string(interface.size()) +
      " interface coordinates; their reduction makes frequencies up to " + rounded(known) + " Hz too high by ";
  return text + (std::isfinite(worst) ? percent(worst, 2) + " at most (first-order bound)"
                                      : "an unknown amount: use [reduction] frequency to retain more modes of parts");
}

/// The reduced frame in the coordinates of the whole.
ReducedModel completed(ReducedModel reduced, const fem::FrameMatrices &frame, Recovered recovered)
{
  ReductionBasis basis;
  basis.q1     = frame.interface_coordinates();
  basis.T      = std::move(recovered.T);
  basis.omega0 = reduced.basis.omega0;
  RefinedModes none; // modal damping is in B* already
  none.P.resize(basis.T.cols(), 0);
  ReducedFrame &known = reduced.frame;
  ReducedFrame  whole = project(frame, basis, {std::move(known.M), std::move(known.B), std::move(known.C)}, none,
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

ReducedModel reduce_in_parts(const fem::FrameMatrices &frame, const fem::CellParts &parts, double alpha, double beta,
                             const ReductionOptions &options, const std::string &place, const Progress &progress)
{
  const CutFrame cut(frame, parts, alpha, beta);
  const int      n = int(frame.M.rows()), n1 = cut.interface().size();
  if (n1 > n - n1)
    throw std::invalid_argument(place + ": parts = " + std::to_string(parts.size()) + " leaves " +
                                std::to_string(n - n1) + " DOFs within the parts and makes " + std::to_string(n1) +
                                " interface DOFs between them; use fewer parts, or parts = \"auto\"");
  const Joined     joined    = join(cut, frame, alpha, beta, options, progress);
  ReducedModel     reduced   = reduce_with_basis(joined.matrices, options, progress);
  const DenseModes modes     = modes_of_interest(reduced.frame);
  Recovered        recovered = recover_all(cut, joined, reduced, modes.V, n, progress);
  reduced.frame.statements.push_back(statement_of(modes, joined, recovered, cut.interface()));
  return completed(std::move(reduced), frame, std::move(recovered));
}

double memory_of_parts(const fem::CellParts &parts, const fem::FrameMatrices &frame, double compactness)
{
  const PartInterface interface(parts, frame.interface_coordinates());
  double              most = 0.;
  for (int p = 0; p < parts.size(); ++p)
  {
    const double n1 = interface.n_held(p);
    // S and M*, a contribution and its sum in elimination
    constexpr double bytes_per_pair = 4. * sizeof(double);
    most = std::max(most, fem::reduction_memory(n1 + interface.n_interior(p), compactness) + bytes_per_pair * n1 * n1);
  }
  // C and M, both triangles with row numbers; half as much for their factor and its work space each
  constexpr double bytes_per_pair = 40.;
  return std::max(most, bytes_per_pair * interface.size() * double(interface.size()));
}

} // namespace gestell::coupling
