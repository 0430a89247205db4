#include "coupling/periodic/followed_equations.h"

#include "coupling/integration/propagation/modal_blocks.h"
#include "coupling/periodic/harmonic/harmonic_balance_method.h"
#include "coupling/periodic/shooting/shooting.h"

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
      equations_.reset();
      member_ = member_at(family_, lambda, ratio_);
      if (member_.problem.period_is_unknown())
        member_.problem.period = z[z.size() - 1];
      equations_ = std::make_unique<ShootingEquations>(member_.problem, options_.integration, omega_);
      lambda_    = lambda;
    }
    equations_->evaluate(z, jacobian);
  }

  const VectorXd  &residual() const override { return equations_->residual(); }
  const MatrixXd  &jacobian() const override { return equations_->jacobian(); }
  double           closing() const override { return equations_->closing(); }
  PeriodicSolution solution() override { return equations_->solution("shooting"); }

private:
  ProblemFamily                      family_;
  PeriodicOptions                    options_;
  double                             omega_;
  int                                ratio_;
  double                             lambda_ = 0.;
  FamilyMember                       member_;
  std::unique_ptr<ShootingEquations> equations_;
};

class BalanceBranch final : public BranchEquations
{
public:
  BalanceBranch(ProblemFamily family, const PeriodicOptions &options) : family_(std::move(family)), options_(options) {}

  VectorXd unknowns(const PeriodicSolution &solution, double lambda) override
  {
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
    closing_ = residual_.cwiseQuotient(balance_->scales(z)).cwiseAbs().maxCoeff();
  }

  const VectorXd  &residual() const override { return residual_; }
  const MatrixXd  &jacobian() const override { return jacobian_; }
  double           closing() const override { return closing_; }
  PeriodicSolution solution() override
  {
    HarmonicNewton newton;
    newton.converged = true;
    newton.residual  = closing_;
    return finished_balance(member_.problem, *balance_, z_, newton, options_);
  }

private:
  void form(double lambda)
  {
    if (balance_ && lambda == lambda_)
      return;
    balance_.reset();
    member_  = member_at(family_, lambda);
    balance_ = std::make_unique<HarmonicBalance>(member_.problem, options_.harmonics);
    lambda_  = lambda;
  }

  ProblemFamily                    family_;
  PeriodicOptions                  options_;
  double                           lambda_ = 0., closing_ = 0.;
  FamilyMember                     member_;
  std::unique_ptr<HarmonicBalance> balance_;
  VectorXd                         z_, residual_;
  MatrixXd                         jacobian_;
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
