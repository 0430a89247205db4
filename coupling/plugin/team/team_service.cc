#include "coupling/plugin/team_service.h"
#include "coupling/plugin/launch_agreement.h"

#include "fem/parallel/ranks.h"

#include <cstdlib>
#include <filesystem>
#include <string>
#include <unistd.h>

namespace gestell::coupling
{

namespace
{

constexpr int dismissal = 0; // all other orders are positive

class Service final : public TeamService
{
public:
  Service()
  {
    MPI_Init(nullptr, nullptr);
    ranks_ = fem::Ranks();
  }
  ~Service() override
  {
    int ended = 0;
    MPI_Finalized(&ended);
    if (!ended)
      MPI_Finalize();
  }

  int rank() const override { return ranks_.rank(); }
  int size() const override { return ranks_.size(); }

  void serve(const std::function<void(int order)> &obey) override
  {
    while (const int order = ranks_.next_order())
      obey(order);
  }
  void dismiss() override { ranks_.order(dismissal); }
  void abort(const char *message) override { ranks_.abort(message); }

private:
  fem::Ranks ranks_;
};

} // namespace

} // namespace gestell::coupling

gestell::coupling::TeamService *gestell_team_service()
{
  static gestell::coupling::Service service;
  return &service;
}

int gestell_ranks_called_otherwise(const char *words, const char *folder)
{
  const gestell::fem::Ranks ranks;
  std::string               words_of_first = words, folder_of_first = folder;
  ranks.broadcast(words_of_first);
  ranks.broadcast(folder_of_first);
  std::error_code none; // one folder may have two names, and on another computer another disk
  const bool      elsewhere = folder_of_first != folder && std::filesystem::exists(folder_of_first, none) &&
                         !std::filesystem::equivalent(folder_of_first, folder, none);
  double others = words_of_first != words || elsewhere ? 1. : 0.;
  ranks.sum(&others, 1);
  return int(others);
}
