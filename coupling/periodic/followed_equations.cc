#include "coupling/periodic/followed_equations.h"

#include "coupling/integration/propagation/modal_blocks.h"
#include "coupling/periodic/harmonic/harmonic_balance_method.h"
#include "coupling/periodic/shooting/shooting.h"

#include <optional>
#include <stdexcept>

namespace gestell::coupling
{

FamilyMember member_at(const ProblemFamily &family, double lambda, int ratio)
{
  try
  {
    FamilyMember member = family(lambda);
    member.problem.period *= ratio;
    member.problem.turn *= ratio;
    member.problem.ratio *= ratio;
    return member;
  }
  catch (const std::invalid_argument &none)
  {
    throw ConvergenceFailure(none.what());
  }
}

namespace
{
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double left_out_of_branch = 1e-8; ///< of the motion, above which harmonics are added

class ShootingBranch final : public BranchEquations
{
public:
  ShootingBranch(ProblemFamily family, const PeriodicOptions &options, double omega, int ratio)
      : family_(std::move(family)), options_(options), omega_(omega), ratio_(ratio)
  {
    if (!options_.integration.modes)
      options_.integration.modes = std::make_shared<SharedModes>();
  }

  VectorXd unknowns(const PeriodicSolution &solution, double) override
  {
    const auto n = solution.q.size();
    VectorXd   z(2 * n);
    z << omega_ * solution.q, solution.v;
    if (!solution.trivial_multiplier)
      return z;
    z.conservativeResize(2 * n + 1);
    z[2 * n] = solution.period;
    return z;
  }

  void evaluate(const VectorXd &z, double lambda, bool jacobian) override
  {
    if (!equations_ || lambda != lambda_)
    {
      const PassageDerivative derivative = equations_ ? equations_->flow().derivative() : PassageDerivative();
      equations_.reset();
      member_ = member_at(family_, lambda, ratio_);
      if (member_.problem.period_is_unknown())
        member_.problem.period = z[z.size() - 1];
      equations_ = std::make_unique<ShootingEquations>(member_.problem, options_.integration, omega_);
      equations_->flow().begin_with(derivative);
      lambda_ = lambda;
    }
    equations_->evaluate(z, jacobian);
    residual_ = equations_->residual();
    jacobian_ = equations_->jacobian();
    closing_  = equations_->closing();
  }

  PeriodicSolution solution() override { return equations_->solution("shooting"); }
  double           parameter_difference() const override
  {
    constexpr double by_fixed_steps = 1e-4; // their ends move from grid to grid, which leaves 1e-8 of a motion
    return equations_->flow().has_tangents() ? BranchEquations::parameter_difference() : by_fixed_steps;
  }

private:
  ProblemFamily                      family_;
  PeriodicOptions                    options_;
  double                             omega_;
  int                                ratio_;
  double                             lambda_ = 0.;
  FamilyMember                       member_;
  std::unique_ptr<ShootingEquations> equations_;
};

/// Harmonics are added where those of the last point leave out too much, unless their number is given.
class BalanceBranch final : public BranchEquations
{
public:
  BalanceBranch(ProblemFamily family, const PeriodicOptions &options)
      : family_(std::move(family)), options_(options), harmonics_(harmonics_of(options))
  {
  }

  VectorXd unknowns(const PeriodicSolution &solution, double lambda) override
  {
    if (harmonics_ == 0)
      harmonics_ = solution.series->harmonics();
    form(lambda);
    return balance_->pack(*solution.series);
  }

  void evaluate(const VectorXd &z, double lambda, bool jacobian) override
  {
    form(lambda);
    z_ = z;
    if (jacobian)
      balance_->linearise(z, residual_, jacobian_);
    else
      balance_->residual(z, residual_);
    closing_ =
        z.size() == 0 ? 0. : residual_.cwiseQuotient(balance_->scales(z)).cwiseAbs().maxCoeff(); // 0: linear machine
  }

  PeriodicSolution solution() override
  {
    PeriodicSolution solution = finished_balance(member_.problem, *balance_, z_, closing_, options_);
    const auto       left     = left_out();
    solution.notes.push_back(
        left ? note_of_harmonics(*balance_, *left, left_out_of_branch, harmonics_of(options_) > 0)
             : "the truncation error of the harmonics is unknown: an undamped mode coincides with a harmonic");
    return solution;
  }

  /// By Newton's method at the value of the parameter; numbers of harmonics that have no solution near by are passed.
  bool refit(const PeriodicSolution &, MatrixXd &Z) override
  {
    if (harmonics_of(options_) > 0)
      return false;
    if (points_to_rest_ > 0)
    {
      --points_to_rest_;
      return false;
    }
    if (const auto left = left_out(); !left || left->motion <= left_out_of_branch)
      return false;
    for (int next = more_harmonics(member_.problem, harmonics_); next > 0; next = more_harmonics(member_.problem, next))
    {
      balance_->set_harmonics(next);
      const VectorXd   start   = balance_->filled_up(Z.col(0), harmonics_);
      VectorXd         z       = start;
      constexpr double near_by = 0.3; // distance of a motion with more harmonics, of the unknowns
      if (!solve_balance(*balance_, options_, z).converged || (z - start).norm() > near_by * start.norm())
        continue;
      const VectorXd tangent = balance_->filled_up(Z.col(1), harmonics_);
      Z.resize(z.size(), 2);
      Z << z, tangent;
      harmonics_ = next;
      return true;
    }
    balance_->set_harmonics(harmonics_);
    // where no more harmonics have a solution: a try costs as much as a point
    constexpr int points_until_next_try = 8;
    points_to_rest_                     = points_until_next_try;
    return false;
  }

private:
  /// Of the last evaluation; none where the base has no response to a harmonic above.
  std::optional<HarmonicBalance::LeftOut> left_out()
  {
    try
    {
      return balance_->left_out(z_);
    }
    catch (const std::invalid_argument &)
    {
      return std::nullopt;
    }
  }

  void form(double lambda)
  {
    if (balance_ && lambda == lambda_)
      return;
    balance_.reset();
    member_      = member_at(family_, lambda);
    auto balance = std::make_unique<HarmonicBalance>(member_.problem, harmonics_);
    balance->require_load();
    balance_ = std::move(balance);
    lambda_  = lambda;
  }

  ProblemFamily                    family_;
  PeriodicOptions                  options_;
  int                              harmonics_, points_to_rest_ = 0;
  double                           lambda_ = 0.;
  FamilyMember                     member_;
  std::unique_ptr<HarmonicBalance> balance_;
  VectorXd                         z_;
};

} // namespace

std::unique_ptr<BranchEquations> shooting_branch(const ProblemFamily &family, const PeriodicOptions &options,
                                                 double omega, int ratio)
{
  return std::make_unique<ShootingBranch>(family, options, omega, ratio);
}

std::unique_ptr<BranchEquations> balance_branch(const ProblemFamily &family, const PeriodicOptions &options)
{
  return std::make_unique<BalanceBranch>(family, options);
}

} // namespace gestell::coupling
