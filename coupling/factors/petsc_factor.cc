#include "coupling/factors/petsc_factor.h"

#include "coupling/algebra/openblas.h"
#include "coupling/algebra/sparse_cholesky.h"
#include "coupling/factors/distributed_factor.h"
#include "coupling/integration/system/convergence_failure.h"
#include "fem/parallel/petsc_session.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <map>
#include <memory>
#include <utility>

namespace gestell::coupling
{

namespace
{

using Eigen::MatrixXd;

enum class Call
{
  make,
  factorise,
  release,
  solve,
  multiply,
  take_back,
  count,
  search,
  find,
  modes,
  end_search,
  forget
};

/// Orders of rank 0: load the libraries (rank 0 does not wait), and carry out a message.
constexpr int prepare_order = 1, factor_order = 2;

/// What rank 0 sends to the others.
struct Message
{
  Call                  call;
  int                   factor          = 0; ///< number
  int                   search          = 0; ///< likewise
  int                   count           = 0;
  double                sigma           = 0.;
  Given                 which           = Given::C;
  BlockLanczos::Options options         = {};
  char                  eigensolver[64] = "";
};

/// Data of rank 0 alone.
struct OnFirst
{
  const FactorMatrices             *matrices = nullptr;
  Eigen::Ref<MatrixXd>             *X        = nullptr;
  const LowestModes                *known    = nullptr;
  const Eigen::Ref<const MatrixXd> *factor   = nullptr; ///< X is added to its product
};

struct Reply
{
  bool                        definite   = true;
  double                      regularity = 0.;
  Inertia                     inertia{};
  LowestModes                 modes{};
  Eigen::SparseMatrix<double> matrix{};
  const ModeSearch           *search = nullptr; ///< of this rank
};

/// Factors and searches of this rank, by number.  Never destroyed, because MPI ends before the process does.
struct Store
{
  std::map<int, std::unique_ptr<DistributedFactor>> factors;
  std::map<int, std::unique_ptr<ModeSearch>>        searches;
};

Store &store()
{
  static auto *const kept = new Store;
  return *kept;
}

/// Options choose the collective calls, and mpirun does not send PETSC_OPTIONS to other computers.
void take_options_of_first(const fem::Ranks &ranks)
{
  const char *given   = std::getenv("PETSC_OPTIONS");
  std::string options = ranks.first() && given ? given : "";
  ranks.broadcast(options);
  if (ranks.first())
    return;
  require_petsc(PetscOptionsClear(nullptr), "options");
  require_petsc(PetscOptionsInsertString(nullptr, options.c_str()), "options");
}

Reply carry_out(const fem::Ranks &ranks, const Message &message, const OnFirst &on_first)
{
  fem::petsc_session();
  auto &[factors, searches] = store();
  const auto factor         = [&]() -> DistributedFactor         &{ return *factors.at(message.factor); };
  Reply      reply;
  switch (message.call)
  {
  case Call::make:
  {
    ranks.agree([] { use_one_blas_thread(); });
    take_options_of_first(ranks);
    const FactorMatrices none;
    factors[message.factor] = std::make_unique<DistributedFactor>(ranks, on_first.matrices ? *on_first.matrices : none);
    break;
  }
  case Call::factorise:
    reply.definite   = factor().factorise();
    reply.regularity = reply.definite ? factor().regularity() : 0.;
    break;
  case Call::release:
    factor().release();
    break;
  case Call::solve:
  {
    MatrixXd             none;
    Eigen::Ref<MatrixXd> nothing(none);
    factor().solve_on_first(on_first.X ? *on_first.X : nothing);
    break;
  }
  case Call::multiply:
  {
    MatrixXd                         none;
    Eigen::Ref<MatrixXd>             nothing(none);
    const Eigen::Ref<const MatrixXd> no_factor(none);
    factor().add_product_on_first(message.which, on_first.factor ? *on_first.factor : no_factor,
                                  on_first.X ? *on_first.X : nothing);
    break;
  }
  case Call::take_back:
    reply.matrix = factor().taken_back_on_first(message.which);
    break;
  case Call::count:
    reply.inertia = factor().inertia(message.sigma);
    break;
  case Call::search:
    searches[message.search] = factor().search(message.eigensolver, message.options, on_first.known);
    break;
  case Call::find:
    reply.search = searches.at(message.search).get();
    searches.at(message.search)->find(message.count);
    break;
  case Call::modes:
    reply.modes = factor().on_first(searches.at(message.search)->modes(message.count));
    break;
  case Call::end_search:
    searches.erase(message.search);
    break;
  case Call::forget:
    factors.erase(message.factor);
    break;
  }
  return reply;
}

/// Failures of carry_out() that all ranks meet alike; another one ends them.
template <typename Work>
auto agreed(const fem::Ranks &ranks, const Work &work)
{
  using Kind = fem::AgreedFailure::Kind;
  try
  {
    return work();
  }
  catch (const fem::AgreedFailure &)
  {
    throw;
  }
  catch (const ConvergenceFailure &failure)
  {
    throw fem::AgreedFailure(Kind::method, failure.what());
  }
  catch (const std::invalid_argument &failure)
  {
    throw fem::AgreedFailure(Kind::wrong_input, failure.what());
  }
  catch (const std::exception &failure)
  {
    if (ranks.size() == 1)
      throw;
    ranks.abort(failure.what());
  }
}

Reply call(const fem::Ranks &ranks, Message message, const OnFirst &on_first = {})
{
  ranks.order(factor_order);
  ranks.broadcast(message);
  try
  {
    return agreed(ranks, [&] { return carry_out(ranks, message, on_first); });
  }
  catch (const fem::AgreedFailure &failure)
  {
    if (failure.kind == fem::AgreedFailure::Kind::wrong_input)
      throw std::invalid_argument(failure.what());
    throw ConvergenceFailure(failure.what());
  }
}

int next_number()
{
  static int number = 0;
  return ++number;
}

class SearchOfRanks final : public ModeSearch
{
public:
  SearchOfRanks(const fem::Ranks &ranks, int factor, int search) : ranks_(ranks), message_{Call::find, factor, search}
  {
  }
  ~SearchOfRanks() override { call(ranks_, with(Call::end_search)); }
  SearchOfRanks(const SearchOfRanks &)            = delete;
  SearchOfRanks &operator=(const SearchOfRanks &) = delete;

  void        find(int count) override { own_ = call(ranks_, with(Call::find, count)).search; }
  LowestModes modes(int count) const override { return call(ranks_, with(Call::modes, count)).modes; }
  Gap         gap_above(int count) const override { return own_->gap_above(count); }

private:
  Message with(Call call, int count = 0) const
  {
    Message message = message_;
    message.call    = call;
    message.count   = count;
    return message;
  }

  fem::Ranks        ranks_;
  Message           message_;
  const ModeSearch *own_ = nullptr; // rank 0's part
};

class PetscFactor final : public StiffnessFactor
{
public:
  PetscFactor(const fem::Ranks &ranks, const FactorMatrices &matrices) : ranks_(ranks), number_(next_number())
  {
    call(ranks_, message(Call::make), {&matrices});
  }
  ~PetscFactor() override { call(ranks_, message(Call::forget)); }
  PetscFactor(const PetscFactor &)            = delete;
  PetscFactor &operator=(const PetscFactor &) = delete;

  void factorise() override
  {
    const Reply reply = call(ranks_, message(Call::factorise));
    regularity_       = reply.regularity;
    if (!reply.definite)
      throw NotPositiveDefinite(-1);
  }
  double regularity() const override { return regularity_; }
  void   release() override { call(ranks_, message(Call::release)); }
  void   solve_in_place(Eigen::Ref<MatrixXd> X) const override { call(ranks_, message(Call::solve), {nullptr, &X}); }

  void add_product(Given which, const Eigen::Ref<const MatrixXd> &X, Eigen::Ref<MatrixXd> Y) const override
  {
    Message multiply = message(Call::multiply);
    multiply.which   = which;
    call(ranks_, multiply, {nullptr, &Y, nullptr, &X});
  }
  Eigen::SparseMatrix<double> taken_back(Given which) const override
  {
    Message take_back = message(Call::take_back);
    take_back.which   = which;
    return call(ranks_, take_back).matrix;
  }

  Inertia below(double omega) override
  {
    Message count = message(Call::count);
    count.sigma   = omega * omega;
    return call(ranks_, count).inertia;
  }

  std::unique_ptr<ModeSearch> search(const std::string &eigensolver, const BlockLanczos::Options &options,
                                     const LowestModes &known) const override
  {
    Message search = message(Call::search);
    search.search  = next_number();
    search.options = options;
    std::strncpy(search.eigensolver, eigensolver.c_str(), sizeof search.eigensolver - 1);
    call(ranks_, search, {nullptr, nullptr, &known});
    return std::make_unique<SearchOfRanks>(ranks_, number_, search.search);
  }

private:
  Message message(Call call) const { return {call, number_}; }

  fem::Ranks ranks_;
  int        number_;
  double     regularity_ = 0.;
};

fem::Ranks &shared_ranks()
{
  static fem::Ranks ranks = fem::Ranks::alone();
  return ranks;
}

} // namespace

std::unique_ptr<StiffnessFactor> petsc_stiffness_factor(const fem::Ranks &ranks, FactorMatrices matrices)
{
  return std::make_unique<PetscFactor>(ranks, matrices);
}

const fem::Ranks &ranks_of_factors()
{
  return shared_ranks();
}

void share_factors()
{
  shared_ranks() = fem::Ranks();
  shared_ranks().order(prepare_order);
}

void serve_petsc_factors(int order)
{
  const fem::Ranks ranks;
  if (order == prepare_order)
    return;
  if (order != factor_order)
    ranks.abort("there is no order " + std::to_string(order) + "; all ranks must run the same version of gestell");
  Message message{Call::forget};
  ranks.broadcast(message);
  try
  {
    agreed(ranks, [&] { return carry_out(ranks, message, {}); });
  }
  catch (const fem::AgreedFailure &)
  {
    // rank 0 reports it
  }
}

} // namespace gestell::coupling
