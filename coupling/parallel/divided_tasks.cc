#include "coupling/parallel/divided_tasks.h"

#include "coupling/algebra/openblas.h"
#include "coupling/eigensolvers/slepc/mode_search.h"
#include "coupling/integration/system/convergence_failure.h"

#include <map>
#include <memory>

namespace gestell::coupling
{

namespace
{

struct Search
{
  const DividedFactor        *factor = nullptr;
  fem::SparseMatrix           M, C; // parts of this rank; C except for block Lanczos
  std::unique_ptr<ModeSearch> modes;
};

/// Factors of this rank, by number. Never destroyed, because MPI ends before the process does.
auto &factors()
{
  static auto *const kept = new std::map<int, std::unique_ptr<DividedFactor>>;
  return *kept;
}
auto &searches()
{
  static auto *const kept = new std::map<int, Search>;
  return *kept;
}

/// Runs work whose result is the same on all ranks: all ranks fail in the same way.
template <typename Work>
auto agreed(const Work &work)
{
  using Kind = fem::AgreedFailure::Kind;
  try
  {
    return work();
  }
  catch (const ConvergenceFailure &failure)
  {
    throw fem::AgreedFailure(Kind::method, failure.what());
  }
  catch (const std::invalid_argument &failure)
  {
    throw fem::AgreedFailure(Kind::wrong_input, failure.what());
  }
}

} // namespace

void DivideTask::run(const fem::Ranks &ranks)
{
  ranks.agree([] { use_one_blas_thread(); });
  ranks.broadcast(number);
  factors()[number] = std::make_unique<DividedFactor>(ranks, matrices);
}

void ForgetFactorTask::run(const fem::Ranks &ranks)
{
  ranks.broadcast(number);
  factors().erase(number);
}

void FactoriseTask::run(const fem::Ranks &ranks)
{
  ranks.broadcast(number);
  DividedFactor &factor = *factors().at(number);
  failed                = factor.factorise();
  pivot_ratio           = failed < 0 ? factor.pivot_ratio() : 0.;
}

void ReleaseFactorTask::run(const fem::Ranks &ranks)
{
  ranks.broadcast(number);
  factors().at(number)->release();
}

void SolveDividedTask::run(const fem::Ranks &ranks)
{
  ranks.broadcast(number);
  Eigen::MatrixXd             none;
  Eigen::Ref<Eigen::MatrixXd> nothing(none);
  factors().at(number)->solve_on_first(X ? *X : nothing);
}

void InertiaTask::run(const fem::Ranks &ranks)
{
  ranks.broadcast(number);
  ranks.broadcast(sigma);
  inertia = factors().at(number)->inertia(sigma);
}

void SearchTask::run(const fem::Ranks &ranks)
{
  ranks.broadcast(number);
  ranks.broadcast(search);
  ranks.broadcast(eigensolver);
  ranks.broadcast(options);
  const DividedFactor &factor = *factors().at(number);
  int                  count  = known ? int(known->omega.size()) : 0;
  ranks.broadcast(count);
  LowestModes rows{Eigen::VectorXd(count), Eigen::MatrixXd(factor.n_rows(), count), Eigen::VectorXd()};
  if (count > 0)
  {
    if (known)
      rows.omega = known->omega;
    ranks.broadcast(rows.omega.data(), count);
    const Eigen::MatrixXd none(0, count);
    factor.deal_out(known ? known->V : none, rows.V);
  }
  Search &made = searches()[search];
  made.factor  = &factor;
  made.M       = factor.own_M();
  if (eigensolver != "block-lanczos")
    made.C = factor.own_C();
  made.modes = agreed(
      [&]
      {
        return search_modes(fem::Ranks::comm(),
                            {std::make_shared<InverseOnRanks>(factor), &made.M, made.C.size() > 0 ? &made.C : nullptr},
                            eigensolver, options, rows);
      });
}

void FindTask::run(const fem::Ranks &ranks)
{
  ranks.broadcast(search);
  ranks.broadcast(count);
  ModeSearch &modes = *searches().at(search).modes;
  found             = &modes;
  agreed([&] { modes.find(count); });
}

void FoundTask::run(const fem::Ranks &ranks)
{
  ranks.broadcast(search);
  ranks.broadcast(count);
  const auto &[factor, M, C, found] = searches().at(search);
  agreed([&] { modes = found->modes(count); });
  Eigen::MatrixXd V(ranks.first() ? factor->n() : 0, count);
  factor->collect(modes.V, V);
  modes.V = std::move(V);
}

void EndSearchTask::run(const fem::Ranks &ranks)
{
  ranks.broadcast(search);
  searches().erase(search);
}

} // namespace gestell::coupling
