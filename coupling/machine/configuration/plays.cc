#include "coupling/machine/configuration/plays.h"

#include "coupling/machine/configuration/dense_matrices.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace gestell::coupling
{

namespace
{

constexpr double rounding = 1e-10; ///< of a row with scaled coordinates, against the whole row

double fastest_turning(const Machine &machine, const Eigen::VectorXd &v)
{
  double fastest = 0.;
  for (const Body &body : machine.model().bodies())
    switch (body.kind)
    {
    case BodyKind::rotor:
      fastest = std::max(fastest, std::abs(v[body.coordinate]));
      break;
    case BodyKind::planar:
      fastest = std::max(fastest, std::abs(v[body.coordinate + 2]));
      break;
    case BodyKind::rigid: // rates of unit directors
      fastest = std::max(fastest, v.segment<9>(body.coordinate + 3).norm() / std::sqrt(2.));
      break;
    default:
      break;
    }
  return fastest;
}

} // namespace

std::vector<PlacedPlay> plays(const Machine &machine, const Eigen::VectorXd &q, const Eigen::VectorXd &v)
{
  const auto             &W = machine.forces().directions();
  const Eigen::VectorXd   u = W.transpose() * q, u_rate = W.transpose() * v;
  std::vector<PlacedPlay> found;
  int                     first = 0;
  for (const ElementPlacement &placement : machine.model().elements())
  {
    const int                   k         = placement.element->n_measures();
    const mechanism::Structure *structure = placement.element->structure();
    Eigen::MatrixXd             own       = Eigen::MatrixXd::Zero(k, mechanism::Play::max_motions);
    const auto                  play =
        structure ? structure->play(u.data() + first, u_rate.data() + first, own.data()) : mechanism::Play();
    if (play.n > 0)
    {
      std::vector<double> gradient(k);
      double              g, curvature;
      const bool chain = structure->closure(u.data() + first, u_rate.data() + first, g, gradient.data(), curvature);
      found.push_back({placement.name, structure, first, k, play, chain,
                       (W.middleCols(first, k) * own.leftCols(play.n)).transpose()});
    }
    first += k;
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const PlacedPlay &a, const PlacedPlay &b) { return a.play.gap < b.play.gap; });
  return found;
}

double free_threshold(const Eigen::MatrixXd &P, double whole)
{
  const double part = P.norm(), least = rounding * whole;
  return part > least ? least / part : 1.;
}

namespace
{

/// Whether a motion allowed by the joints moves the clearance while the frame and all coordinates with given speeds are
/// at rest.
bool is_free_to_move(const Machine &machine, const std::vector<char> &v_given, const LocalState &state,
                     const Eigen::MatrixXd &play)
{
  std::vector<int> free;
  for (int i = machine.model().n_frame(); i < machine.size(); ++i)
    if (!v_given[i])
      free.push_back(i);
  const int       n_c = machine.joints().n_rows(), n_f = int(free.size());
  Eigen::MatrixXd own(play.rows(), n_f), joints(n_f, n_c);
  for (int i = 0; i < n_f; ++i)
    own.col(i) = play.col(free[i]);
  if (n_c == 0 || n_f == 0)
    return own.norm() > rounding * play.norm();
  ConstraintJacobian G(machine.joints().blocks());
  Eigen::VectorXd    g = Eigen::VectorXd::Zero(n_c);
  machine.joints().constraints(state, g, G);
  const Eigen::MatrixXd rows = joint_jacobian(machine, G);
  for (int i = 0; i < n_f; ++i)
    joints.row(i) = rows.col(free[i]);
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(joints);
  const Eigen::MatrixXd                             Q = qr.householderQ();
  return (own * Q.rightCols(n_f - qr.rank())).norm() > rounding * play.norm();
}

} // namespace

std::vector<std::string> closing_warnings(const Machine &machine, const std::vector<char> &v_given,
                                          const Eigen::VectorXd &q, const Eigen::VectorXd &v)
{
  const double turning = fastest_turning(machine, v);
  LocalState   state;
  state.resize(machine);
  machine.gather(0., q, v, Eigen::VectorXd::Zero(machine.size()), state);
  std::vector<std::string> warnings;
  for (const PlacedPlay &own : plays(machine, q, v))
  {
    const double speed = own.rate().norm();
    // A journal crosses its clearance at speeds of gap times the angular speed of the shaft; ten times that has another
    // cause.
    constexpr double crossings = 10.;
    if (!own.play.both || !(own.play.gap > 0.) || speed <= crossings * own.play.gap * turning ||
        speed <= rounding * v.norm() || !is_free_to_move(machine, v_given, state, own.G))
      continue;
    std::ostringstream text;
    text << "the initial state closes the clearance of \"" << own.name << "\" at " << std::setprecision(3) << speed
         << " m/s (or rad/s): the initial speeds of the bodies on both sides are inconsistent, so the first impact is "
            "caused by the initial state only. Use start.rule = \"steady\" with the speed of the drive in start.v, or "
            "give the speeds of these bodies there, also if zero";
    warnings.push_back(text.str());
  }
  return warnings;
}

} // namespace gestell::coupling
