#include "coupling/periodic/harmonic/harmonic_forces.h"

#include "coupling/integration/system/turning_forces.h"

#include <cmath>
#include <complex>
#include <stdexcept>
#include <string>

namespace gestell::coupling
{

namespace
{

using Eigen::MatrixXcd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

int samples_for(const PeriodicProblem &problem, int harmonics, int samples)
{
  const bool    branches      = problem.system->events().save_history().size() > 0;
  constexpr int least_samples = 64, smooth_share = 8;        // samples for each harmonic: laws of degree 7 are exact
  constexpr int least_of_branches = 1024, branch_share = 32; // kinks feed back from far above H
  if (samples == 0)
    return power_of_two(branches ? std::max(least_of_branches, branch_share * harmonics)
                                 : std::max(least_samples, smooth_share * harmonics));
  if (samples <= 4 * harmonics)
    throw std::invalid_argument("harmonic balance: " + std::to_string(samples) + " samples of a period for " +
                                std::to_string(harmonics) + " harmonics; more than " + std::to_string(4 * harmonics) +
                                " are needed");
  return power_of_two(samples);
}

} // namespace

std::complex<double> HarmonicForces::Derivative::at(int h, double l_omega) const
{
  const auto coefficient = [h](const VectorXcd &c) -> std::complex<double>
  {
    if (std::abs(h) >= c.size())
      return 0.;
    return h >= 0 ? c[h] : std::conj(c[-h]);
  };
  auto sum = coefficient(of_u) + std::complex<double>(0., l_omega) * coefficient(of_v);
  if (of_a.size() > 0)
    sum -= l_omega * l_omega * coefficient(of_a);
  return sum;
}

HarmonicForces::HarmonicForces(const PeriodicProblem &problem, int harmonics, int samples)
    : problem_(problem), harmonics_(harmonics), n_u_(int(problem.system->forces().directions().cols())),
      transform_(samples_for(problem, harmonics, samples)), entry_state_(problem.system->events().save_history())
{
  turn_u_ = VectorXd::Zero(n_u_);
  if (problem.turn.size() > 0)
    turn_u_ = problem.system->forces().directions().transpose() * problem.turn;
  state_.resize(n_u_);
  const int N = transform_.samples();
  for (Eigen::MatrixXd *x : {&u_, &v_, &a_, &p_, &slope_samples_})
    x->setZero(N, n_u_);
  for (Eigen::MatrixXd *x : {&dp_du_, &dp_dv_, &dp_da_})
    x->setZero(n_u_, n_u_);
  forces_.setZero(n_u_, N / 2 + 1);
  slope_ = forces_;
  gather_entries();
}

HarmonicForces::~HarmonicForces()
{
  problem_.system->events().restore_history(entry_state_);
}

void HarmonicForces::gather_entries()
{
  for (const ForceBlock &block : problem_.system->forces().blocks())
    for (int j = 0; j < block.n_measures; ++j)
      for (int i = 0; i < block.n_measures; ++i)
        derivatives_.push_back({block.first_measure + i, block.first_measure + j, {}, {}, {}});
  for (Eigen::MatrixXd *x : {&of_u_, &of_v_, &of_a_})
    x->setZero(transform_.samples(), Eigen::Index(derivatives_.size()));
}

void HarmonicForces::sample_motion(const MatrixXcd &u, double omega)
{
  omega_      = omega;
  const int N = transform_.samples();
  VectorXcd c;
  for (int i = 0; i < n_u_; ++i)
  {
    c = u.row(i).transpose();
    transform_.values(c, u_.col(i).data());
    for (Eigen::MatrixXd *rate : {&v_, &a_})
    {
      for (Eigen::Index h = 0; h < c.size(); ++h)
        c[h] *= std::complex<double>(0., double(h) * omega);
      transform_.values(c, rate->col(i).data());
    }
    u_.col(i) += VectorXd::LinSpaced(N, 0., double(N - 1) / N) * turn_u_[i];
    v_.col(i).array() += turn_u_[i] * omega / (2. * M_PI);
  }
}

/// As they are at t_0, in the branch of the motion.
void HarmonicForces::start_elements()
{
  set_state(0);
  problem_.system->events().follow_history(false); // an integration in between may have changed it
  problem_.system->events().start(state_);
  if (!problem_.system->forces().held().empty())
    throw std::invalid_argument("harmonic balance: an element sticks at the beginning of the period, and its sticking "
                                "force has no force law; give its friction a regularised law, or use shooting");
}

void HarmonicForces::set_state(int k)
{
  state_.t = problem_.begin + 2. * M_PI / omega_ * k / transform_.samples();
  state_.u = u_.row(k);
  state_.v = v_.row(k);
  state_.a = a_.row(k);
}

/// Laws of u'' have their derivatives from tangent() alone.
void HarmonicForces::add_derivatives_over_u2(int k)
{
  problem_.system->forces().tangent(state_, 0., 0., 1., state_.p, dp_da_);
  for (std::size_t e = 0; e < derivatives_.size(); ++e)
    of_a_(k, e) = dp_da_(derivatives_[e].i, derivatives_[e].j);
}

void HarmonicForces::evaluate_sample(int k, With with)
{
  const LocalForces &forces = problem_.system->forces();
  set_state(k);
  if (with == With::forces)
    forces.force(state_, state_.p);
  else
  {
    linearise(forces, state_, state_.p, dp_du_, dp_dv_);
    for (std::size_t e = 0; e < derivatives_.size(); ++e)
    {
      of_u_(k, e) = dp_du_(derivatives_[e].i, derivatives_[e].j);
      of_v_(k, e) = dp_dv_(derivatives_[e].i, derivatives_[e].j);
    }
  }
  p_.row(k) = state_.p;
  if (with != With::forces)
    add_derivatives_over_u2(k);
}

void HarmonicForces::evaluate(const MatrixXcd &u, double omega, With with)
{
  if (n_u_ == 0)
    return;
  sample_motion(u, omega);
  start_elements();
  for (int k = 0; k < transform_.samples(); ++k)
    evaluate_sample(k, with);
  for (int i = 0; i < n_u_; ++i)
  {
    transform_.coefficients(p_.col(i).data(), coefficients_);
    forces_.row(i) = coefficients_.transpose();
  }
  if (with == With::forces)
    return;
  depends_on_u2_        = !of_a_.isZero(0.);
  const auto transforms = [this](const Eigen::MatrixXd &of, std::size_t e)
  {
    transform_.coefficients(of.col(Eigen::Index(e)).data(), coefficients_);
    return coefficients_;
  };
  for (std::size_t e = 0; e < derivatives_.size(); ++e)
  {
    derivatives_[e].of_u = transforms(of_u_, e);
    derivatives_[e].of_v = transforms(of_v_, e);
    derivatives_[e].of_a = depends_on_u2_ ? transforms(of_a_, e) : VectorXcd();
  }
  if (with != With::slope)
    return;
  // u' is proportional to omega, u'' to its square
  slope_samples_.setZero();
  for (std::size_t e = 0; e < derivatives_.size(); ++e)
    slope_samples_.col(derivatives_[e].i).array() += (of_v_.col(e).array() * v_.col(derivatives_[e].j).array() +
                                                      2. * of_a_.col(e).array() * a_.col(derivatives_[e].j).array()) /
                                                     omega;
  for (int i = 0; i < n_u_; ++i)
  {
    transform_.coefficients(slope_samples_.col(i).data(), coefficients_);
    slope_.row(i) = coefficients_.transpose();
  }
}

MatrixXcd HarmonicForces::sampling_errors() const
{
  const FourierTransform coarse(samples() / 2);
  MatrixXcd              errors(n_u_, harmonics_ + 1);
  VectorXcd              c;
  for (int i = 0; i < n_u_; ++i)
  {
    const VectorXd every_other = p_(Eigen::seq(0, Eigen::last, 2), i);
    coarse.coefficients(every_other.data(), c);
    errors.row(i) = (forces_.row(i).head(harmonics_ + 1) - c.transpose().head(harmonics_ + 1)) / 3.;
  }
  return errors;
}

Eigen::MatrixXd HarmonicForces::sampled(const MatrixXcd &u, double omega)
{
  sample_motion(u, omega);
  start_elements();
  Eigen::MatrixXd p(transform_.samples(), n_u_);
  for (int k = 0; k < transform_.samples(); ++k)
  {
    evaluate_sample(k, With::forces);
    p.row(k) = state_.p;
  }
  return p;
}

VectorXd HarmonicForces::changes(const MatrixXcd &u, const MatrixXcd &other, double omega)
{
  const Eigen::MatrixXd before = sampled(u, omega), after = sampled(other, omega);
  return (after - before).cwiseAbs().colwise().maxCoeff().transpose();
}

VectorXd HarmonicForces::ranges() const
{
  return (p_.colwise().maxCoeff() - p_.colwise().minCoeff()).transpose();
}

HarmonicForces::Memory HarmonicForces::memory(const MatrixXcd &u, double omega)
{
  EventSystem &events = problem_.system->events();
  if (n_u_ == 0 || events.save_history().size() == 0)
    return {};
  const Eigen::MatrixXd fresh      = sampled(u, omega);
  VectorXd              difference = VectorXd::Zero(n_u_);
  for (int period = 0; period < 2; ++period)
    for (int k = 0; k < transform_.samples(); ++k)
    {
      evaluate_sample(k, With::forces);
      difference = difference.cwiseMax((state_.p - fresh.row(k).transpose()).cwiseAbs());
      events.accept(state_);
    }
  Eigen::Index worst   = 0;
  Memory       memory  = {difference.maxCoeff(&worst), ""};
  const double largest = fresh.cwiseAbs().maxCoeff();
  if (largest > 0.)
    memory.share /= largest;
  memory.element = problem_.system->forces().element_of(int(worst));
  return memory;
}

} // namespace gestell::coupling
