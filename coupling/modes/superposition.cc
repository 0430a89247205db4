#include "coupling/modes/superposition.h"
#include "coupling/integration/system/fastest_load.h"

#include "coupling/algebra/sparse_cholesky.h"
#include "coupling/eigensolvers/sparse_modes.h"
#include "coupling/integration/system/fastest_load.h"
#include "coupling/machine/configuration/dense_matrices.h"
#include "coupling/machine/dense_base.h"
#include "coupling/machine/sparse_base.h"
#include "fem/values/two_pi.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace gestell::coupling
{

namespace
{

using Eigen::MatrixXd;
using Eigen::VectorXd;
using SparseMatrix = Eigen::SparseMatrix<double>;

constexpr int first_search = 16; ///< modes: doubled until enough
/// more modes than a machine's loads reach; the frame then needs another method
constexpr int    most_automatic  = 512;
constexpr double usual_tolerance = 0.01; ///< of static deflections: as exact as a frame is reduced to
constexpr double above_loads     = 4.;   ///< the book's rule: 3 to 4 times the highest excitation frequency

struct AveragedSystem
{
  SparseMatrix M, K;
};

AveragedSystem averaged(const Machine &machine, const VectorXd &q, const std::vector<std::string> &open)
{
  AveragedSystem system;
  if (const auto *sparse = dynamic_cast<const SparseBase *>(&machine.base()))
  {
    system.M = sparse->mass();
    system.K = sparse->stiffness();
  }
  else
  {
    system.M = dense_mass(machine).sparseView();
    system.K = dense_stiffness(machine).sparseView();
  }
  system.K = SparseMatrix(system.K + engaged_stiffness(machine, q, open));
  return system;
}

[[noreturn]] void refuse(const std::string &place, const std::string &reason, const std::string &way_out)
{
  throw std::invalid_argument(place + ": method = \"modal\" does not apply: " + reason + "; " + way_out);
}

const char *const other_methods = "use method = \"craig-bampton\", which retains such coordinates";

/// The angle of a rotating body, or -1.
int angle_of(const Body &body)
{
  return body.kind == BodyKind::rotor ? body.coordinate : body.kind == BodyKind::planar ? body.coordinate + 2 : -1;
}

/// A body driven by a torque that depends on the speed; empty: none.
std::string driven_body(const Machine &machine, std::string &drive)
{
  const Eigen::Index n_u = machine.forces().directions().cols();
  LocalState         rest;
  rest.resize(machine);
  VectorXd p    = VectorXd::Zero(n_u);
  MatrixXd by_u = MatrixXd::Zero(n_u, n_u), by_v = by_u;
  machine.forces().derivatives(rest, p, by_u, by_v);
  Eigen::Index measure = 0;
  for (const ElementPlacement &placement : machine.model().elements())
    for (const Measure &u : placement.measures)
    {
      const bool by_speed = placement.element->work() == mechanism::Work::input && by_v(measure, measure) != 0.;
      ++measure;
      for (const Body &body : machine.model().bodies())
        for (const auto &term : u)
          if (by_speed && angle_of(body) == term.first)
          {
            drive = placement.name;
            return body.name;
          }
    }
  return "";
}

void refuse_massless(const Machine &machine, const SparseMatrix &M, const std::string &place)
{
  const VectorXd   mass    = M.diagonal();
  constexpr double no_mass = 1e-14; // of the largest: rounding of averaged terms
  for (int i = 0; i < machine.size(); ++i)
    if (!(mass[i] > no_mass * mass.maxCoeff()))
      refuse(place, "the coordinate \"" + machine.coordinate_name(i) + "\" has no mass",
             std::string("give it one, or ") + other_methods);
}

/// The coordinate with most of the kinetic energy.
std::string moving_most(const Machine &machine, const SparseMatrix &M, const VectorXd &v)
{
  Eigen::Index most;
  (M.diagonal().array() * v.array().square()).maxCoeff(&most);
  return most < machine.model().n_frame() ? "the frame" : "\"" + machine.coordinate_name(int(most)) + "\"";
}

void refuse_free_motions(const Machine &machine, const SparseMatrix &M, const DenseModes &modes,
                         const std::string &place)
{
  for (Eigen::Index j = 0; j < modes.omega.size(); ++j)
  {
    if (j < modes.growth.size() && modes.growth[j] > 0.)
      refuse(place, "the position is unstable: " + moving_most(machine, M, modes.V.col(j)) + " leaves it",
             "choose a stable position");
    if (modes.omega[j] == 0.)
      refuse(place,
             moving_most(machine, M, modes.V.col(j)) + " moves freely: this motion has no stiffness (frequency zero)",
             std::string("add a spring, or ") + other_methods);
  }
}

SparseCholesky factor(const Machine &machine, const SparseMatrix &K, const std::string &place)
{
  try
  {
    return SparseCholesky(K);
  }
  catch (const NotPositiveDefinite &failure)
  {
    refuse(place, "the motion of \"" + machine.coordinate_name(failure.row) + "\" has no stiffness",
           std::string("add a spring, or ") + other_methods);
  }
}

/// Directions of elements and loads [n x k].
MatrixXd directions(const Machine &machine)
{
  const auto           &loads = machine.linear().excitation();
  std::vector<VectorXd> columns;
  for (int j = 0; j < machine.forces().directions().cols(); ++j)
    columns.emplace_back(machine.forces().directions().col(j));
  if (!loads.constant().isZero(0.))
    columns.push_back(loads.constant());
  for (const Excitation::Harmonic &harmonic : loads.harmonics())
  {
    VectorXd cosine = VectorXd::Zero(machine.size()), sine = cosine;
    for (const Excitation::Entry &entry : harmonic.load)
    {
      cosine[entry.coordinate] += entry.cosine;
      sine[entry.coordinate] += entry.sine;
    }
    columns.push_back(cosine);
    columns.push_back(sine);
  }
  MatrixXd result(machine.size(), Eigen::Index(columns.size()));
  for (std::size_t j = 0; j < columns.size(); ++j)
    result.col(Eigen::Index(j)) = columns[j];
  return result;
}

/// Truncation error of static deflections for numbers of modes.
class StaticShortfall
{
public:
  StaticShortfall(const Machine &machine, const SparseCholesky &stiffness)
      : w_(directions(machine)), n_elements_(machine.forces().directions().cols())
  {
    MatrixXd deflections = w_;
    if (w_.cols() > 0)
      stiffness.solve_in_place(deflections);
    full_ = w_.cwiseProduct(deflections).colwise().sum();
  }

  Eigen::Index n_elements() const { return n_elements_; } ///< directions of elements, the first ones

  /// The largest share for the first 1, 2, ... modes; for the directions of elements only, or also of loads.
  VectorXd of(const DenseModes &modes, bool elements_alone = false) const
  {
    const Eigen::Index n    = elements_alone ? n_elements_ : w_.cols();
    VectorXd           left = VectorXd::Zero(modes.omega.size()), carried = VectorXd::Zero(w_.cols());
    for (Eigen::Index j = 0; j < left.size(); ++j)
    {
      carried += ((w_.transpose() * modes.V.col(j)) / modes.omega[j]).cwiseAbs2();
      for (Eigen::Index k = 0; k < n; ++k)
        if (full_[k] > 0.)
          left[j] = std::max(left[j], 1. - carried[k] / full_[k]);
    }
    return left;
  }

private:
  MatrixXd     w_;
  Eigen::Index n_elements_;
  VectorXd     full_;
};

DenseModes lowest(const AveragedSystem &system, int count)
{
  const int     n               = int(system.M.rows());
  constexpr int few_coordinates = 600; // all modes are found at once: less than a second
  if (n > few_coordinates)
    return sparse_modes(system.K, system.M, std::min(count, n));
  DenseModes modes = dense_modes(MatrixXd(system.K), MatrixXd(system.M));
  const auto m     = std::min<Eigen::Index>(count, modes.omega.size());
  return {VectorXd(modes.omega.head(m)), MatrixXd(modes.V.leftCols(m)), VectorXd(modes.growth.head(m))};
}

/// Number of modes requested by the options, from those computed; more if these do not suffice.
class ModeCount
{
public:
  ModeCount(const Machine &machine, const SuperpositionOptions &options, const StaticShortfall &shortfall)
      : options_(options), shortfall_(shortfall), n_(machine.size()),
        limit_(options.frequency > 0. ? two_pi * options.frequency
                                      : above_loads * fastest_load(machine.linear().excitation())),
        elements_alone_(limit_ > 0. && !(options.tolerance > 0.)),
        tolerance_(options.tolerance > 0.                                                   ? options.tolerance
                   : options.frequency > 0. || (limit_ > 0. && shortfall.n_elements() == 0) ? 0.
                                                                                            : usual_tolerance)
  {
    const auto wrong = [&](const std::string &text) { throw std::invalid_argument(options.place + ": " + text); };
    if (options.n_modes == 0)
      wrong("modes is 0, but method = \"modal\" needs at least one mode");
    if (options.n_modes > n_)
      wrong("modes is " + std::to_string(options.n_modes) + ", but frame and mechanism have " + std::to_string(n_) +
            " coordinates; give no more");
  }

  int first() const { return options_.n_modes > 0 ? options_.n_modes : std::min(first_search, n_); }

  /// @param requested  number of modes searched for.
  /// @return 0: cannot be determined from these
  int of(const DenseModes &modes, int requested)
  {
    const int found = int(modes.omega.size());
    if (options_.n_modes > 0)
      return std::min(options_.n_modes, found);
    const int by_limit     = limit_ > 0. ? std::max(1, int((modes.omega.array() <= limit_).count())) : 0;
    const int by_tolerance = tolerance_ > 0. ? enough_for_statics(modes) : 0;
    const int count        = std::max(by_limit, by_tolerance);
    if (count < found || found == n_ || found < requested)
      return std::min(count, found);
    ended_ = found >= most_automatic;
    return ended_ ? found : 0;
  }

  bool        ended() const { return ended_; } ///< more modes would have been required
  std::string rule() const
  {
    std::ostringstream text;
    text.precision(4);
    const auto statics = [&]
    {
      text << "as many as needed to miss at most " << 100. * tolerance_ << " % of a static deflection"
           << (elements_alone_ ? " under forces of elements" : "");
    };
    if (options_.n_modes > 0)
      text << "number given by reduction.modes";
    else if (options_.frequency > 0.)
      text << "all up to reduction.frequency, " << options_.frequency << " Hz";
    else if (limit_ > 0.)
      text << "all up to " << above_loads << " times the highest frequency of the loads, " << limit_ / two_pi << " Hz";
    if (options_.n_modes <= 0 && tolerance_ > 0.)
    {
      text << (limit_ > 0. ? ", and at least " : "");
      statics();
    }
    if (ended_)
      text << ": the search ended at " << most_automatic;
    return text.str();
  }

private:
  /// The number found + 1 if these are not sufficient.
  int enough_for_statics(const DenseModes &modes) const
  {
    const VectorXd left  = shortfall_.of(modes, elements_alone_);
    int            count = 0;
    while (count < left.size() && left[count] > tolerance_)
      ++count;
    return count + 1;
  }

  const SuperpositionOptions &options_;
  const StaticShortfall      &shortfall_;
  int                         n_;
  double                      limit_;          ///< [rad/s]; 0: by the tolerance
  bool                        elements_alone_; ///< loads count by their frequency
  double                      tolerance_;      ///< 0: by the limit
  bool                        ended_ = false;
};

/// Largest |b_ij| / sqrt(b_ii b_jj) of V^T B V.
double damping_between_modes(const Machine &machine, const MatrixXd &V)
{
  MatrixXd BV(V.rows(), V.cols());
  VectorXd column(V.rows());
  for (Eigen::Index j = 0; j < V.cols(); ++j)
  {
    machine.linear().damping_times(V.col(j), column);
    BV.col(j) = column;
  }
  const MatrixXd B    = V.transpose() * BV;
  double         most = 0.;
  for (Eigen::Index i = 0; i < B.rows(); ++i)
    for (Eigen::Index j = 0; j < i; ++j)
      if (B(i, i) > 0. && B(j, j) > 0.)
        most = std::max(most, std::abs(B(i, j)) / std::sqrt(B(i, i) * B(j, j)));
  return most;
}

void tell(const SuperpositionOptions &options, const std::string &rule, Superposition &result)
{
  std::ostringstream text;
  text.precision(3);
  const VectorXd &omega = result.modes.omega;
  text << "modal superposition: " << omega.size() << " modes of frame and mechanism, " << rule << "; the highest has "
       << omega[omega.size() - 1] / two_pi << " Hz, static deflections under forces and loads are up to "
       << 100. * result.static_residual << " % too small";
  result.statements.push_back(text.str());
  constexpr double much_left = 0.05; // of a static deflection, worth a note: five times the usual tolerance
  if (result.static_residual > much_left)
    result.notes.push_back("modal superposition: static deflections under forces and loads are up to " +
                           std::to_string(int(std::lround(100. * result.static_residual))) +
                           " % too small without the truncated modes; use more modes, or method = \"craig-bampton\", "
                           "whose statics are exact");
  // of damping between two modes, for a note: it moves roots by its square, 1 %
  constexpr double considerable_share = 0.1;
  if (options.diagonal_damping && result.coupling > considerable_share)
    result.notes.push_back("modal superposition: damping = \"diagonal\" ignores coupling of modes by up to " +
                           std::to_string(int(std::lround(100. * result.coupling))) +
                           " % of their damping; damping = \"full\" includes it");
}

/// Adds notes on loads above the highest retained mode, and on forces of elements with unknown frequencies.
void note_loads(const Machine &machine, const SuperpositionOptions &options, const ModeCount &rule,
                Superposition &result)
{
  std::ostringstream text;
  text.precision(3);
  text << "modal superposition: ";
  const double highest = result.modes.omega[result.modes.omega.size() - 1],
               fastest = fastest_load(machine.linear().excitation());
  const auto note      = [&](const std::string &way_out) { result.notes.push_back(text.str() + way_out); };
  if (fastest > highest)
  {
    text << "a load has " << fastest / two_pi << " Hz, above the highest retained mode, " << highest / two_pi
         << " Hz; ";
    note("use more modes");
    return;
  }
  if (rule.ended())
  {
    text << "the search for modes ended at " << result.modes.omega.size() << " modes, " << highest / two_pi << " Hz; ";
    note("give reduction.modes, or use method = \"craig-bampton\"");
    return;
  }
  if (options.n_modes > 0 || options.frequency > 0.)
    return;
  for (const ElementPlacement &placement : machine.model().elements())
    if (placement.element->work() == mechanism::Work::input)
    {
      text << "\"" << placement.name
           << "\" excites the machine by a force of unknown frequencies, and only modes up to " << highest / two_pi
           << " Hz are retained; ";
      note("give reduction.frequency, four times the highest relevant frequency");
      return;
    }
}

} // namespace

void check_superposition(const Machine &machine, const std::string &place)
{
  if (machine.joints().n_rows() > 0)
    refuse(place, machine.joints().name(0) + " is an ideal joint, which modal superposition cannot satisfy",
           std::string("give it a compliance, or ") + other_methods);
  for (const int i : machine.linear().virtual_coordinates())
    refuse(place, "\"" + machine.coordinate_name(i) + "\" is a virtual coordinate without mass", other_methods);
  std::string drive;
  if (const std::string rotor = driven_body(machine, drive); !rotor.empty())
    refuse(place, "\"" + drive + "\" turns \"" + rotor + "\", whose angle does not vibrate about a position",
           other_methods);
}

Superposition superpose(const Machine &machine, const VectorXd &q, const SuperpositionOptions &options)
{
  check_superposition(machine, options.place);
  const AveragedSystem system = averaged(machine, q, options.open);
  refuse_massless(machine, system.M, options.place);
  refuse_free_motions(machine, system.M, lowest(system, 1), options.place);
  const StaticShortfall shortfall(machine, factor(machine, system.K, options.place));
  ModeCount             rule(machine, options, shortfall);
  DenseModes            modes;
  int                   count = 0;
  for (int requested = rule.first(); count == 0; requested *= 2)
  {
    modes = lowest(system, requested);
    count = rule.of(modes, std::min(requested, machine.size()));
  }
  Superposition result;
  result.modes = {modes.omega.head(count), modes.V.leftCols(count), options.diagonal_damping};
  if (machine.forces().directions().cols() > 0 || !machine.linear().excitation().constant().isZero(0.) ||
      fastest_load(machine.linear().excitation()) > 0.)
    result.static_residual = shortfall.of(modes)[count - 1];
  result.coupling = damping_between_modes(machine, result.modes.V);
  tell(options, rule.rule(), result);
  note_loads(machine, options, rule, result);
  return result;
}

} // namespace gestell::coupling
