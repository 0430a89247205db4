#include "coupling/machine/configuration/assembly.h"

#include "coupling/integration/system/dense_solvers.h"
#include "coupling/machine/configuration/constraint_rank.h"
#include "coupling/machine/configuration/coordinate_sizes.h"
#include "coupling/machine/configuration/dense_matrices.h"
#include "coupling/machine/configuration/plays.h"

#include <Eigen/Geometry>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace gestell::coupling
{

namespace
{

constexpr double closed = 1e-10; ///< share of its terms that counts as closed where rounding stops progress

/// Value of a measure, or of a rate: of a measure or of a rigid body's rotation.
struct Demand
{
  std::string      name; ///< for messages
  double           value;
  std::string      measure;
  const KnownSpin *spin = nullptr;
};

std::vector<Demand> demands_of(const std::vector<std::pair<std::string, double>> &measures,
                               const std::vector<KnownSpin>                      &spins)
{
  std::vector<Demand> demands;
  for (const auto &[name, value] : measures)
    demands.push_back({"the measure \"" + name + "\"", value, name});
  for (const KnownSpin &spin : spins)
    demands.push_back({"the angular velocity \"" + spin.body + ".w" + "xyz"[spin.axis] + "\"", spin.value, "", &spin});
  return demands;
}

class Assembly
{
public:
  Assembly(Machine &machine, const KnownStart &known)
      : machine_(machine), known_(known), measures_(demands_of(known.measures, {})),
        rates_(demands_of(known.rates, known.spins)), state_(known.state), G_(machine.joints().blocks()),
        n_c_(G_.n_rows()), yielding_(compliant_joints(machine))
  {
    local_.resize(machine);
    g_.setZero(n_c_);
    rate_.setZero(n_c_);
    bias_.setZero(n_c_);
    machine.gather(state_.t, state_.q, state_.v, Eigen::VectorXd::Zero(machine.size()), local_);
    machine.events().start(local_); // initialises the laws of driven joints
  }

  InitialState assembled(BehindPlay bodies)
  {
    with_yielding([this] { return close(); });
    if (bodies == BehindPlay::followed)
      close_plays();
    refuse_dependent();
    with_yielding([this] { return turn(); });
    if (bodies == BehindPlay::followed)
      turn_plays();
    return state_;
  }

private:
  /// Treats compliant joints as ideal, or lets them open if the assembly fails.
  template <class Closing>
  void with_yielding(const Closing &closing)
  {
    const InitialState before = state_;
    if (!yielding_.empty() && closing())
      return;
    yielding_.clear();
    state_ = before;
    closing();
  }

  /// Given values may separate bodies that are in contact or within a play in the scene; these follow if joints permit.
  void close_plays()
  {
    const InitialState joined = state_;
    while (tear())
      if (!close())
      {
        state_ = joined;
        break;
      }
    torn_.clear();
  }

  /// Whether further plays are torn: the body that closes one leaves the next.
  bool tear()
  {
    const Eigen::VectorXd described = Eigen::VectorXd::Zero(machine_.size());
    const auto            before    = plays(machine_, described, described);
    const std::size_t     so_far    = torn_.size();
    for (const PlacedPlay &own : plays(machine_, state_.q, described))
    {
      const auto is_own = [&own](const PlacedPlay &p) { return p.first_measure == own.first_measure; };
      const bool known  = std::find(torn_.begin(), torn_.end(), own.first_measure) != torn_.end();
      if (own.play.both && own.play.presses() && !known &&
          !std::find_if(before.begin(), before.end(), is_own)->play.presses())
        torn_.push_back(own.first_measure);
    }
    return torn_.size() > so_far;
  }

  /// Makes bodies on both sides of a clearance move together, as far as joints and given speeds allow.
  void turn_plays()
  {
    const auto own = plays(machine_, state_.q, state_.v);
    if (std::none_of(own.begin(), own.end(), [](const PlacedPlay &p) { return p.play.both; }))
      return;
    Eigen::VectorXd residual;
    Eigen::MatrixXd rows;
    evaluate(rates_, residual, rows, true);
    const Free free(machine_, known_.v_given);
    if (free.index.empty())
      return;
    Eigen::MatrixXd Z = residual.size() > 0 ? LeastSquaresSolver(free.scaled(rows), 1e-12).null_space()
                                            : Eigen::MatrixXd::Identity(free.scale.size(), free.scale.size());
    for (const PlacedPlay &place : own)
    {
      const Eigen::MatrixXd G = free.scaled(place.G), P = G * Z;
      const double          threshold = free_threshold(P, G.norm());
      if (!place.play.both || threshold >= 1.)
        continue;
      const LeastSquaresSolver solver(P, threshold);
      const Eigen::VectorXd    rate = place.G * state_.v, x = solver.solve(-rate);
      const double             still = closed * machine_length(machine_.model()) * relative_speed(machine_, state_.v);
      if (rate.cwiseAbs().maxCoeff() > still)
      {
        if ((P * x + rate).cwiseAbs().maxCoeff() > still)
          continue;
        free.add(Z * x, state_.v);
      }
      Z = Z * solver.null_space();
    }
  }

  /// Coordinates of bodies that are not given, scaled to equal mass.
  struct Free
  {
    Free(const Machine &machine, const std::vector<char> &given)
    {
      for (int i = machine.model().n_frame(); i < machine.size(); ++i)
        if (!given[i])
          index.push_back(i);
      scale.resize(Eigen::Index(index.size()));
      Eigen::VectorXd unit = Eigen::VectorXd::Zero(machine.size()), column = unit;
      for (std::size_t j = 0; j < index.size(); ++j)
      {
        unit[index[j]] = 1.;
        machine.linear().mass_times(unit, column);
        unit[index[j]]         = 0.;
        const double m         = column[index[j]];
        scale[Eigen::Index(j)] = m > 0. ? 1. / std::sqrt(m) : 1.;
      }
    }
    Eigen::MatrixXd scaled(const Eigen::MatrixXd &rows) const { return rows(Eigen::all, index) * scale.asDiagonal(); }
    void            add(const Eigen::VectorXd &x, Eigen::VectorXd &to) const { to(index) += scale.cwiseProduct(x); }

    std::vector<int> index;
    Eigen::VectorXd  scale;
  };

  /// Rows: joints, then measures, then compliant joints, then plays; columns: coordinates of the machine.
  void evaluate(const std::vector<Demand> &demands, Eigen::VectorXd &residual, Eigen::MatrixXd &rows, bool rates)
  {
    machine_.gather(state_.t, state_.q, state_.v, Eigen::VectorXd::Zero(machine_.size()), local_);
    machine_.joints().constraints(local_, g_, G_);
    for (const auto &[row, shift] : known_.shifts)
      g_[row] -= shift;
    Eigen::Index n_yielding = 0;
    for (const CompliantPlace &own : yielding_)
      n_yielding += own.joint->n_equations();
    const auto   plays_to_close = torn_plays();
    Eigen::Index n_torn         = 0;
    for (const PlacedPlay &own : plays_to_close)
      n_torn += own.play.n;
    residual.resize(n_c_ + Eigen::Index(demands.size()) + n_yielding + n_torn);
    rows.resize(residual.size(), machine_.size());
    if (rates)
    {
      machine_.joints().rates(local_, rate_, bias_);
      g_ = rate_;
      G_.add_product(1., local_.v, g_);
    }
    residual.head(n_c_) = g_;
    rows.topRows(n_c_)  = joint_jacobian(machine_, G_);
    Eigen::VectorXd gradient;
    for (std::size_t i = 0; i < demands.size(); ++i)
    {
      const Demand &demand = demands[i];
      double        value  = 0.;
      if (demand.spin)
      {
        gradient = spin_gradient(machine_, *demand.spin, state_.q);
        value    = gradient.dot(state_.v);
      }
      else
      {
        const auto measured = machine_.model().measure(demand.measure).evaluate(state_.q, state_.v, &gradient);
        value               = rates ? measured.rate : measured.s;
      }
      residual[n_c_ + Eigen::Index(i)] = value - demand.value;
      rows.row(n_c_ + Eigen::Index(i)) = gradient.transpose();
    }
    add_yielding(n_c_ + Eigen::Index(demands.size()), residual, rows, rates);
    for (const PlacedPlay &own : plays_to_close)
    {
      residual.segment(residual.size() - n_torn, own.play.n) = own.s();
      rows.middleRows(rows.rows() - n_torn, own.play.n)      = own.G;
      n_torn -= own.play.n;
    }
  }

  std::vector<PlacedPlay> torn_plays() const
  {
    if (torn_.empty())
      return {};
    auto own = plays(machine_, state_.q, Eigen::VectorXd::Zero(machine_.size()));
    own.erase(std::remove_if(own.begin(), own.end(),
                             [this](const PlacedPlay &p)
                             { return std::find(torn_.begin(), torn_.end(), p.first_measure) == torn_.end(); }),
              own.end());
    return own;
  }

  void add_yielding(Eigen::Index row, Eigen::VectorXd &residual, Eigen::MatrixXd &rows, bool rates) const
  {
    double gradient[mechanism::PlacedMeasure::max_measures];
    for (const CompliantPlace &own : yielding_)
      for (int i = 0; i < own.joint->n_equations(); ++i, ++row)
      {
        const auto opening =
            own.joint->opening(i, local_.u.data() + own.first_measure, local_.v.data() + own.first_measure, gradient);
        residual[row] = rates ? opening.rate : opening.s;
        const int  k  = own.joint->n_measures();
        const auto W  = machine_.forces().directions().middleCols(own.first_measure, k);
        rows.row(row) = (W * Eigen::Map<const Eigen::VectorXd>(gradient, k)).transpose();
      }
  }

  /// Bodies start with their given rotation.
  void guess_spins()
  {
    for (const Body &body : machine_.model().bodies())
    {
      Eigen::Vector3d omega = Eigen::Vector3d::Zero();
      for (const KnownSpin &known : known_.spins)
        if (known.body == body.name)
          omega[known.axis] = known.value;
      for (int i = 0; body.kind == BodyKind::rigid && i < 3; ++i)
      {
        const int first = body.coordinate + 3 + 3 * i;
        state_.v.segment<3>(first) += omega.cross(Eigen::Vector3d::Unit(i) + state_.q.segment<3>(first));
      }
    }
  }

  /// Returns whether compliant joints are closed too.  Lengths and angles have no common size: the error of a position
  /// is the mass-weighted distance that would close it to first order.
  bool close()
  {
    Eigen::VectorXd residual, next;
    Eigen::MatrixXd rows;
    const Free      free(machine_, known_.q_given);
    evaluate(measures_, residual, rows, false);
    constexpr int most_iterations = 60; // Newton's with halved steps: a few tens from afar, a few near by
    for (int k = 0; k < most_iterations && residual.size() > 0 && !free.index.empty(); ++k)
    {
      const LeastSquaresSolver solver(free.scaled(rows), 1e-12);
      const Eigen::VectorXd    way = solver.solve(-residual), q = state_.q;
      const double             off  = way.norm();
      double                   part = 1., then = 0.;
      for (;; part *= 0.5) // shorter where the whole way leads further off
      {
        state_.q = q;
        free.add(part * way, state_.q);
        evaluate(measures_, next, rows, false);
        then = solver.solve(next).norm();
        if (then < off || part < 1e-3)
          break;
      }
      const bool better = then < 0.5 * off;
      if (!(then < off))
      {
        state_.q = q;
        break;
      }
      residual = next;
      if (!better && residual.cwiseQuotient(terms(measures_)).cwiseAbs().maxCoeff() < closed)
        break;
    }
    evaluate(measures_, residual, rows, false);
    return is_closed(residual, measures_, "m or rad", "positions");
  }

  /// Redundant equations leave multipliers undetermined, as does an unconstrained position.
  void refuse_dependent()
  {
    if (n_c_ == 0)
      return;
    Eigen::VectorXd residual;
    Eigen::MatrixXd rows;
    evaluate({}, residual, rows, false);
    rows.conservativeResize(n_c_, Eigen::NoChange);
    if (const ConstraintRank rank(machine_, rows); !rank.full())
      throw std::invalid_argument(rank.dependence());
  }

  bool turn()
  {
    Eigen::VectorXd residual;
    Eigen::MatrixXd rows;
    const Free      free(machine_, known_.v_given);
    guess_spins();
    for (int k = 0; k < 2; ++k) // linear: the second time takes what rounding left
    {
      evaluate(rates_, residual, rows, true);
      if (residual.size() > 0 && !free.index.empty()) // the smallest change
        free.add(LeastSquaresSolver(free.scaled(rows), 1e-12).solve(-residual), state_.v);
    }
    evaluate(rates_, residual, rows, true);
    return is_closed(residual, rates_, "m/s or rad/s", "velocities");
  }

  /// Size of the terms of each row of evaluate() [m, rad], for their rounding.
  Eigen::VectorXd terms(const std::vector<Demand> &demands) const
  {
    std::vector<double> sizes;
    for (const ConstraintBlock &block : G_.blocks())
      sizes.insert(sizes.end(), std::size_t(block.n_rows), block.size);
    const double length = machine_length(machine_.model());
    for (const Demand &demand : demands)
      sizes.push_back(!demand.spin && machine_.model().measure(demand.measure).unit == "m" ? length : 1.);
    for (const CompliantPlace &own : yielding_)
      sizes.insert(sizes.end(), std::size_t(own.joint->n_equations()), own.joint->size_of_terms());
    for (const PlacedPlay &own : torn_plays())
      sizes.insert(sizes.end(), std::size_t(own.play.n), length);
    Eigen::VectorXd terms = Eigen::Map<const Eigen::VectorXd>(sizes.data(), Eigen::Index(sizes.size()));
    return terms.unaryExpr([](double size) { return size > 0. ? size : 1.; }); // 0: only angles
  }

  /// Returns false if compliant joints or plays must open.
  /// @throws std::invalid_argument if other joints stay open without them
  bool is_closed(const Eigen::VectorXd &residual, const std::vector<Demand> &demands, const std::string &unit,
                 const std::string &what) const
  {
    if (residual.size() == 0)
      return true;
    int          worst = 0;
    const double open  = residual.cwiseAbs().maxCoeff(&worst);
    const double rate  = what == "velocities" ? relative_speed(machine_, state_.v) : 1.;
    if (residual.cwiseQuotient(terms(demands)).cwiseAbs().maxCoeff() <= closed * rate)
      return true;
    if (!yielding_.empty() || !torn_.empty())
      return false;
    std::ostringstream message;
    message << "the mechanism cannot be assembled: with the given " << what << " "
            << (worst < n_c_ ? "the joint " + machine_.joints().name(worst) : demands[worst - n_c_].name)
            << " has a gap of " << open << " " << unit
            << "; check its points and lengths, or give fewer or other values in [start]";
    throw std::invalid_argument(message.str());
  }

  Machine                    &machine_;
  const KnownStart           &known_;
  std::vector<Demand>         measures_, rates_;
  InitialState                state_;
  LocalState                  local_;
  ConstraintJacobian          G_;
  Eigen::VectorXd             g_, rate_, bias_;
  int                         n_c_;
  std::vector<CompliantPlace> yielding_; ///< compliant joints that are to close
  std::vector<int>            torn_;     ///< plays that are to close, by the first measure of their element
};

} // namespace

InitialState assemble(Machine &machine, const KnownStart &known, BehindPlay bodies)
{
  return Assembly(machine, known).assembled(bodies);
}

/// e . omega = 1/2 sum d_i' . (e x d_i)
Eigen::VectorXd spin_gradient(const Machine &machine, const KnownSpin &spin, const Eigen::VectorXd &q)
{
  const int             first    = machine.model().body(spin.body).coordinate + 3;
  const Eigen::Vector3d e        = Eigen::Vector3d::Unit(spin.axis);
  Eigen::VectorXd       gradient = Eigen::VectorXd::Zero(machine.size());
  for (int i = 0; i < 3; ++i)
    gradient.segment<3>(first + 3 * i) = 0.5 * e.cross(Eigen::Vector3d::Unit(i) + q.segment<3>(first + 3 * i));
  return gradient;
}

std::vector<CompliantPlace> compliant_joints(const Machine &machine)
{
  std::vector<CompliantPlace> found;
  int                         first = 0;
  for (const ElementPlacement &placement : machine.model().elements())
  {
    if (const auto *joint = dynamic_cast<const mechanism::CompliantJoint *>(placement.element.get()))
      found.push_back({joint, first});
    first += placement.element->n_measures();
  }
  return found;
}

bool has_joints(const Machine &machine)
{
  return machine.joints().n_rows() > 0 || !compliant_joints(machine).empty();
}

} // namespace gestell::coupling
