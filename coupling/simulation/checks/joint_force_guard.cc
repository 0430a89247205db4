#include "coupling/simulation/checks/joint_force_guard.h"

#include "coupling/integration/system/state_archive.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>
#include <tuple>

namespace gestell::coupling
{

namespace
{
constexpr double epsilon = std::numeric_limits<double>::epsilon();
const double     limit   = 1. / std::sqrt(epsilon);
} // namespace

JointForceGuard::JointForceGuard(const Machine &machine, const TimeIntegrator &integrator)
    : machine_(machine), integrator_(integrator), load_(machine.linear().excitation().constant()), product_(load_)
{
  if (machine.joints().n_rows() == 0)
    return;
  for (const ForceBlock &block : machine.forces().blocks())
    for (int i = 0; i < block.n_measures; ++i)
      of_forces_.push_back(block.first_measure + i);
  double largest = 0.;
  for (const ConstraintBlock &block : machine.joints().blocks())
    largest = std::max(largest, block.size);
  if (largest > 0.)
    size_ = largest;
  find_inertias();
}

/// Finds for each coordinate the measure of a joint that equals this coordinate.
void JointForceGuard::find_inertias()
{
  const auto &W = machine_.forces().directions();

  std::map<int, std::pair<int, double>> measures; // by coordinate: measure and its weight
  for (const ConstraintBlock &block : machine_.joints().blocks())
    for (int j = block.first_measure; j < block.first_measure + block.n_measures; ++j)
      if (Eigen::SparseMatrix<double>::InnerIterator it(W, j); it && W.col(j).nonZeros() == 1)
        if (auto &[measure, weight] = measures[int(it.row())]; std::abs(it.value()) > weight)
          std::tie(measure, weight) = std::pair(j, std::abs(it.value()));
  Eigen::VectorXd unit = Eigen::VectorXd::Zero(W.rows());
  for (const auto &[coordinate, of] : measures)
  {
    unit[coordinate] = 1.;
    machine_.linear().mass_times(unit, product_);
    unit[coordinate] = 0.;
    inertias_.push_back({of.first, product_[coordinate] / of.second});
    masses_ += product_[coordinate];
  }
}

/// Size of loads, element forces, inertia forces and rounding.
double JointForceGuard::known_forces()
{
  const LocalState &now = integrator_.local();
  const double      h   = now.t - integrator_.step_begin();
  if (!machine_.linear().excitation().is_constant())
    machine_.linear().excitation().at(now.t, load_);
  double sum = load_.lpNorm<1>();
  for (const int i : of_forces_)
    sum += std::abs(now.p[i]);
  for (const Inertia &inertia : inertias_)
    sum += inertia.mass * std::abs(now.a[inertia.measure]);
  return sum + (h > 0. ? masses_ * epsilon * size_ / (h * h) : 0.);
}

double JointForceGuard::elastic_forces()
{
  const Instant &now = integrator_.instant();
  machine_.linear().stiffness_times(now.q, product_);
  const double elastic = product_.lpNorm<1>();
  machine_.linear().damping_times(now.v, product_);
  return elastic + product_.lpNorm<1>();
}

void JointForceGuard::step()
{
  const Eigen::VectorXd &lambda = integrator_.local().lambda;
  if (machine_.joints().n_rows() == 0 || lambda.size() == 0)
    return;
  Eigen::Index row;
  const double force = lambda.cwiseAbs().maxCoeff(&row), lever = std::max(size_, 1. / size_), bound = limit * lever;
  if (!(force > lever * largest_))
    return; // forces seen before explain it
  largest_ = std::max(largest_, known_forces());
  if (!(force > bound * largest_))
    return;
  largest_ = std::max(largest_, known_forces() + elastic_forces()); // expensive and rarely needed
  if (!(force > bound * largest_))
    return;
  std::ostringstream text;
  text.precision(2);
  text << "the force of the joint " << machine_.joints().name(int(row)) << " is " << force
       << " (N or N m) at t = " << integrator_.time()
       << " s, but all loads, elements and inertia forces of the machine add up to " << largest_
       << ", so it is not physical. Joints constrain a DOF twice here, or constrain one that should be free: check "
          "points and axes of this joint and its neighbours, make one of them compliant by a 'stiffness', or start in "
          "another position";
  throw ConvergenceFailure(text.str());
}

void JointForceGuard::exchange(StateArchive &archive)
{
  archive(largest_);
}

} // namespace gestell::coupling
