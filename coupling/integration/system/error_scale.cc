#include "coupling/integration/system/error_scale.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <tuple>

namespace gestell::coupling
{

namespace
{

double highest(const std::vector<SpectrumLine> &spectrum)
{
  double omega = 0.;
  for (const SpectrumLine &line : spectrum)
    omega = std::max(omega, line.omega);
  return omega;
}

} // namespace

double slowest_elastic(const std::vector<SpectrumLine> &spectrum)
{
  constexpr double rigid  = 1e-7; // modes below this part of the highest frequency are rigid motions
  const double     least  = rigid * highest(spectrum);
  double           lowest = std::numeric_limits<double>::infinity();
  for (const SpectrumLine &line : spectrum)
    if (line.omega > least)
      lowest = std::min(lowest, line.omega);
  return lowest;
}

ErrorScale::ErrorScale(const SecondOrderSystem &system, const std::vector<SpectrumLine> &spectrum, double tolerance)
    : system_(system), tolerance_(tolerance), omega_1_(slowest_elastic(spectrum)), omega_n_(highest(spectrum))
{
  find_masses();
  find_groups();
  find_ends();
  const auto n = m_.size(), n_u = system.forces().directions().cols(), n_ends = Eigen::Index(end_index_.size());
  for (Eigen::VectorXd *x : {&q_begin_, &v_begin_})
    x->setZero(n);
  for (Eigen::VectorXd *x : {&u_begin_, &rate_begin_, &inverse_u_, &inverse_rate_, &way_, &speed_, &size_, &rate_})
    x->setZero(n_u);
  for (Eigen::VectorXd *x : {&inverse_q_, &inverse_v_})
    x->setZero(n_groups_);
  for (Excursions *x : {&accepted_, &reached_, &expected_, &scale_})
  {
    x->q.setZero(n_groups_);
    x->v.setZero(n_groups_);
    x->u.setZero(n_u);
    x->u_rate.setZero(n_u);
    x->end_q.setZero(n_ends);
    x->end_v.setZero(n_ends);
  }
  sums_.assign(n_groups_, 0.);
  sums_v_.assign(n_groups_, 0.);
  changes_.assign(n_groups_, 0.);
  moved_.assign(n_groups_, 0.);
}

void ErrorScale::copy(const Excursions &from, Excursions &to)
{
  for (const auto x : all)
    to.*x = from.*x;
}

/// M_ii: by unit vectors, or for large systems from x_i (M x)_i with many x of random signs, whose mean is M_ii.
void ErrorScale::find_masses()
{
  const int       n = system_.linear().size();
  Eigen::VectorXd x = Eigen::VectorXd::Zero(n), y(n);
  m_.setZero(n);
  // coordinates up to which M_ii is computed and not estimated: n products, as fast as a factor
  constexpr int exact_masses = 1000;
  if (n <= exact_masses)
    for (int i = 0; i < n; ++i)
    {
      x[i] = 1.;
      system_.linear().mass_times(x, y);
      m_[i] = y[i];
      x[i]  = 0.;
    }
  else
  {
    std::mt19937  random(1);
    constexpr int probes = 64; // the error of an estimate by random signs is 1/8 of the other entries in its row
    for (int k = 0; k < probes; ++k)
    {
      for (int i = 0; i < n; ++i)
        x[i] = (random() & 1u) != 0 ? 1. : -1.;
      system_.linear().mass_times(x, y);
      m_ += x.cwiseProduct(y) / probes;
    }
  }
  m_        = m_.cwiseMax(0.);
  massless_ = static_cast<int>((m_.array() <= 0.).count());
  if (massless_ == n)
    m_.setOnes();
}

/// Connected components of the graph of M, B, C: what a product with them reaches from a coordinate.  Vectors have
/// irregular entries, so that a rigid motion does not hide couplings.
void ErrorScale::find_groups()
{
  const int        n = system_.linear().size();
  std::vector<int> group(n, -1);
  Eigen::VectorXd  x(n), y(n);
  for (int seed = 0; seed < n; ++seed)
  {
    if (group[seed] >= 0)
      continue;
    group[seed]          = n_groups_;
    int          reached = 1, before = 0;
    std::mt19937 random(1);
    while (reached > before)
    {
      before = reached;
      for (int i = 0; i < n; ++i)
        x[i] = group[i] == n_groups_ ? 1. + random() / 4294967296. : 0.;
      for (const auto product :
           {&LinearSystem::mass_times, &LinearSystem::damping_times, &LinearSystem::stiffness_times})
      {
        (system_.linear().*product)(x, y);
        constexpr double uncoupled = 1e-13; // entries of M, B, C below this part of the largest do not couple
        const double     least     = uncoupled * y.lpNorm<Eigen::Infinity>();
        for (int i = 0; i < n; ++i)
          if (group[i] < 0 && std::abs(y[i]) > least)
          {
            group[i] = n_groups_;
            ++reached;
          }
      }
    }
    ++n_groups_;
  }
  for (int i = 0; i < n; ++i)
    if (runs_.empty() || runs_.back().group != group[i])
      runs_.push_back({i, 1, group[i]});
    else
      ++runs_.back().size;
}

void ErrorScale::find_ends()
{
  const auto      &W = system_.forces().directions();
  std::vector<int> place(W.rows(), -1);

  std::vector<Eigen::Triplet<double>> entries;
  for (int j = 0; j < W.outerSize(); ++j)
    for (Eigen::SparseMatrix<double>::InnerIterator it(W, j); it; ++it)
    {
      int &row = place[it.row()];
      if (row < 0)
      {
        row = static_cast<int>(end_index_.size());
        end_index_.push_back(static_cast<int>(it.row()));
      }
      entries.emplace_back(row, j, std::abs(it.value()));
    }
  ends_.resize(static_cast<Eigen::Index>(end_index_.size()), W.cols());
  ends_.setFromTriplets(entries.begin(), entries.end());

  end_group_.assign(end_index_.size(), 0);
  for (const Run &run : runs_)
    for (std::size_t k = 0; k < end_index_.size(); ++k)
      if (end_index_[k] >= run.first && end_index_[k] < run.first + run.size)
        end_group_[k] = run.group;
  root_mass_.setZero(W.cols());
  for (int j = 0; j < W.outerSize(); ++j)
  {
    double mobility = 0.;
    for (Eigen::SparseMatrix<double>::InnerIterator it(W, j); it; ++it)
      if (m_[it.row()] > 0.)
        mobility += it.value() * it.value() / m_[it.row()];
    root_mass_[j] = mobility > 0. ? 1. / std::sqrt(mobility) : 0.;
  }
  Eigen::VectorXd unit = Eigen::VectorXd::Zero(W.rows()), product(W.rows());
  for (const int i : system_.linear().virtual_coordinates())
  {
    unit[i] = 1.;
    system_.linear().damping_times(unit, product);
    const double b = product[i];
    system_.linear().stiffness_times(unit, product);
    const double c = product[i];
    unit[i]        = 0.;
    for (int j = 0; j < W.outerSize(); ++j)
      if (W.coeff(i, j) != 0.)
        virtual_.push_back({j, c > 0. ? b / c : 0., c > 0. ? 1. / c : 0., Eigen::VectorXd::Zero(W.cols()),
                            Eigen::VectorXd::Zero(W.cols())});
  }
}

void ErrorScale::expect(double way, double speed)
{
  loads_way_   = way;
  loads_speed_ = speed;
}

void ErrorScale::laws(const Eigen::MatrixXd &dp_du, const Eigen::MatrixXd &dp_dv)
{
  for (Virtual &z : virtual_)
  {
    z.by_u               = z.by_u.cwiseMax(z.part * dp_du.row(z.measure).cwiseAbs().transpose());
    z.by_rate            = z.by_rate.cwiseMax(z.part * dp_dv.row(z.measure).cwiseAbs().transpose());
    z.by_u[z.measure]    = 0.; // of itself
    z.by_rate[z.measure] = 0.;
  }
}

/// sum m_i (x_i - from_i)^2 of each group; returns their sum.
double ErrorScale::energy(const Vector &x, const Vector *from, std::vector<double> &sums) const
{
  std::fill(sums.begin(), sums.end(), 0.);
  for (const Run &run : runs_)
  {
    const auto m = m_.segment(run.first, run.size).array();
    const auto y = x.segment(run.first, run.size).array();
    sums[run.group] +=
        from ? (m * (y - from->segment(run.first, run.size).array()).square()).sum() : (m * y.square()).sum();
  }
  return std::accumulate(sums.begin(), sums.end(), 0.);
}

void ErrorScale::begin(const Motion &at)
{
  q_begin_    = at.q;
  v_begin_    = at.v;
  u_begin_    = at.u;
  rate_begin_ = at.u_rate;
  find_noise();
  for (const auto x : all)
    (accepted_.*x).setZero();
  for (Virtual &z : virtual_)
  {
    z.by_u.setZero();
    z.by_rate.setZero();
  }
  loads_way_ = loads_speed_ = 0.;
  expected_until_           = -std::numeric_limits<double>::infinity();
}

void ErrorScale::accept()
{
  copy(reached_, accepted_);
}

void ErrorScale::refuse()
{
  if (t_ <= expected_until_)
    return;
  copy(reached_, expected_);
  expected_until_ = t_;
}

bool ErrorScale::consider(double t, double h, const Motion &from, const Motion &to, const Vector &moved)
{
  t_ = t;
  const Vector q_begin(q_begin_), v_begin(v_begin_);
  const double total = energy(to.q, &q_begin, sums_) + energy(to.v, &v_begin, sums_v_);
  if (!std::isfinite(total + to.u.sum() + to.u_rate.sum()))
    return false;
  for (int g = 0; g < n_groups_; ++g)
  {
    reached_.q[g] = std::max(accepted_.q[g], std::sqrt(sums_[g]));
    reached_.v[g] = std::max(accepted_.v[g], std::sqrt(sums_v_[g]));
  }
  reached_.u      = accepted_.u.cwiseMax((to.u - u_begin_).cwiseAbs());
  reached_.u_rate = accepted_.u_rate.cwiseMax((to.u_rate - rate_begin_).cwiseAbs());
  for (std::size_t k = 0; k < end_index_.size(); ++k)
  {
    const int i       = end_index_[k];
    reached_.end_q[k] = std::max(accepted_.end_q[k], std::abs(to.q[i] - q_begin_[i]));
    reached_.end_v[k] = std::max(accepted_.end_v[k], std::abs(to.v[i] - v_begin_[i]));
  }
  copy(reached_, scale_);
  if (t <= expected_until_)
    for (const auto x : all)
      scale_.*x = (scale_.*x).cwiseMax(expected_.*x);
  set_scales(h, from, to, moved);
  return true;
}

/// chi, and from it 1 / (scale chi), but not above what rounding leaves, which reaches velocities with the highest
/// frequency that the step resolves; a motion that does not move has no error.
std::pair<double, double> ErrorScale::invert(double h, const Excursion &of) const
{
  const auto [E, V, change_of_speed, size, rate] = of;
  constexpr double rounding  = 8. * std::numeric_limits<double>::epsilon(); // of sums of a few terms
  const double     floor     = rounding / tolerance_;
  const bool       moves     = E > 0. && V > 0.;
  const double     chi       = moves ? std::min(1., std::max(h * V / E, change_of_speed / V)) : 1.;
  const double     frequency = moves ? std::min(1. / h, std::max(omega_n_, 10. * V / E)) : 1. / h;
  const double     q         = std::max(E * chi, floor * std::max(size, h * rate));
  const double     v         = std::max(V * chi, floor * std::max(size * frequency, rate));
  return {q > 0. ? 1. / q : 0., v > 0. ? 1. / v : 0.};
}

void ErrorScale::set_scales(double h, const Motion &from, const Motion &to, const Vector &moved)
{
  const double time    = 1. / omega_1_; // zero for a system without elastic modes: no bound
  const auto   bounded = [&](double way, double speed) { return time > 0. ? std::min(way, speed * time) : way; };
  double       most = loads_way_, fastest = loads_speed_;
  for (int g = 0; g < n_groups_; ++g)
  {
    most    = std::max(most, bounded(scale_.q[g], scale_.v[g]));
    fastest = std::max(fastest, scale_.v[g]);
  }
  energy(to.q, nullptr, sums_);
  energy(to.v, nullptr, sums_v_);
  energy(to.v, &from.v, changes_);
  std::fill(moved_.begin(), moved_.end(), 0.);
  for (int j = 0; j < ends_.outerSize(); ++j)
    for (Eigen::SparseMatrix<double>::InnerIterator it(ends_, j); it; ++it)
    {
      double &largest = moved_[end_group_[it.row()]];
      largest         = std::max(largest, std::abs(moved[j]) * root_mass_[j]);
    }
  constexpr double group_floor = 1e-6; // of the group that moves most, in its energy norm
  for (int g = 0; g < n_groups_; ++g)
    std::tie(inverse_q_[g], inverse_v_[g]) =
        invert(h, {std::max(bounded(scale_.q[g], scale_.v[g]), group_floor * most),
                   std::max(scale_.v[g], group_floor * fastest), std::sqrt(changes_[g]),
                   std::max({std::sqrt(sums_[g]), moved_[g], noise_of_groups_[g]}),
                   std::max(std::sqrt(sums_v_[g]), moved_[g] / h)});

  for (int j = 0; j < ends_.outerSize(); ++j)
  {
    double way = 0., speed = 0.;
    double size = std::max({std::abs(to.u[j]), std::abs(moved[j]), noise_[j]});
    double rate = std::max(std::abs(to.u_rate[j]), std::abs(moved[j]) / h);
    for (Eigen::SparseMatrix<double>::InnerIterator it(ends_, j); it; ++it)
    {
      way += it.value() * bounded(scale_.end_q[it.row()], scale_.end_v[it.row()]);
      speed += it.value() * scale_.end_v[it.row()];
      size = std::max(size, it.value() * std::abs(to.q[end_index_[it.row()]]));
      rate = std::max(rate, it.value() * std::abs(to.v[end_index_[it.row()]]));
    }
    const double     part          = root_mass_[j] > 0. ? group_floor / root_mass_[j] : 0.;
    constexpr double measure_floor = 1e-3; // of the excursions of the coordinates a measure is made of
    way_[j]   = std::max({bounded(scale_.u[j], scale_.u_rate[j]), measure_floor * way, part * most});
    speed_[j] = std::max({scale_.u_rate[j], measure_floor * speed, part * fastest});
    size_[j]  = size;
    rate_[j]  = rate;
    std::tie(inverse_u_[j], inverse_rate_[j]) =
        invert(h, {way_[j], speed_[j], std::abs(to.u_rate[j] - from.u_rate[j]), size, rate});
  }
  set_scales_of_virtual(h);
}

void ErrorScale::set_scales_of_virtual(double h)
{
  for (const Virtual &z : virtual_)
  {
    const int j = z.measure;
    // share of the effect of other measures' excursions on the law of a virtual coordinate
    constexpr double law_floor = 1e-3;
    const double     law       = law_floor * (z.by_u.dot(way_) + z.by_rate.dot(speed_));
    const double     way = std::max(way_[j], law), speed = z.time > 0. ? std::max(speed_[j], law / z.time) : speed_[j];
    const double     left =
        z.by_u.dot(size_) + z.by_rate.dot(rate_) + z.by_rate.dot(joint_noise_) / (z.time + h); // h/(T + h) of noise/h
    const double size = std::max(size_[j], left);
    inverse_u_[j]     = invert(h, {way, speed, 0., size, rate_[j]}).first;
    inverse_rate_[j]  = 0.;
  }
}

double ErrorScale::error_of_measures(const Vector &e_u, const Vector &e_rate) const
{
  double largest = 0.;
  for (Eigen::Index j = 0; j < e_u.size(); ++j)
    largest = std::max({largest, std::abs(e_u[j]) * inverse_u_[j], std::abs(e_rate[j]) * inverse_rate_[j]});
  return largest;
}

double ErrorScale::error(const Motion &e) const
{
  double largest = error_of_measures(e.u, e.u_rate);
  energy(e.q, nullptr, sums_);
  energy(e.v, nullptr, sums_v_);
  for (int g = 0; g < n_groups_; ++g)
    largest = std::max({largest, std::sqrt(sums_[g]) * inverse_q_[g], std::sqrt(sums_v_[g]) * inverse_v_[g]});
  return largest;
}

std::string ErrorScale::worst(const Motion &e) const
{
  double      largest = -1.;
  std::string name;
  const auto  compare = [&](double size, int coordinate, const char *what)
  {
    if (size > largest)
    {
      largest = size;
      name    = what + system_.linear().coordinate_name(coordinate);
    }
  };
  for (const Run &run : runs_)
    for (int i = run.first; i < run.first + run.size; ++i)
      compare(std::sqrt(m_[i]) *
                  std::max(std::abs(e.q[i]) * inverse_q_[run.group], std::abs(e.v[i]) * inverse_v_[run.group]),
              i, "");
  for (int j = 0; j < ends_.outerSize(); ++j)
    for (Eigen::SparseMatrix<double>::InnerIterator it(ends_, j); it; ++it)
      compare(std::max(std::abs(e.u[j]) * inverse_u_[j], std::abs(e.u_rate[j]) * inverse_rate_[j]),
              end_index_[it.row()], "the force on ");
  return name;
}

} // namespace gestell::coupling
