#include "coupling/factors/own_factor.h"

#include "coupling/algebra/sparse_cholesky.h"
#include "coupling/eigensolvers/slepc/mode_search.h"

#include <utility>

namespace gestell::coupling
{

namespace
{

using Eigen::MatrixXd;

class OwnStiffnessFactor final : public StiffnessFactor
{
public:
  explicit OwnStiffnessFactor(FactorMatrices matrices)
      : matrices_(std::move(matrices)), factor_(SparseCholesky::without_numbers(matrices_.stiffness(), matrices_.held))
  {
  }

  void factorise() override
  {
    if (factor_.released())
      factor_.factorise(matrices_.stiffness(), matrices_.available);
  }
  double regularity() const override { return factor_.pivot_ratio(); }
  void   release() override { factor_.release(); }

  void solve_in_place(Eigen::Ref<MatrixXd> X) const override
  {
    for (const int i : matrices_.held)
      X.row(i).setZero();
    factor_.solve_in_place(X);
  }

  Inertia below(double omega) override { return factor_.inertia(matrices_.stiffness(), *matrices_.M, omega * omega); }

  std::unique_ptr<ModeSearch> search(const std::string &eigensolver, const BlockLanczos::Options &options,
                                     const LowestModes &known) const override
  {
    return search_modes(MPI_COMM_SELF,
                        {std::make_shared<InverseByFactor>(factor_, matrices_.held), matrices_.M, matrices_.C},
                        eigensolver, options, known);
  }

private:
  FactorMatrices matrices_;
  SparseCholesky factor_;
};

} // namespace

std::unique_ptr<StiffnessFactor> own_stiffness_factor(FactorMatrices matrices)
{
  return std::make_unique<OwnStiffnessFactor>(std::move(matrices));
}

} // namespace gestell::coupling
