// A team of ranks with a task that fails, or does not, in the way the one argument says.  Called by team_test.

#include "coupling/reduction/team.h"

#include <cstdlib>
#include <iostream>
#include <stdexcept>
#include <string>

namespace
{

using gestell::coupling::Order;
using gestell::coupling::Team;
using gestell::fem::Ranks;

struct Trial
{
  static constexpr Order order = Order(1000);
  std::string            how;
  int                    sum = 0;

  void run(const Ranks &ranks)
  {
    ranks.broadcast(how);
    ranks.agree(
        [&]
        {
          if (how == "agreed" && ranks.rank() == 1)
            throw std::invalid_argument("the part of this rank is wrong");
        });
    if (how == "abrupt" && ranks.rank() == 1)
      throw std::runtime_error("this rank broke down");
    MPI_Reduce(&ranks_of_one, &sum, 1, MPI_INT, MPI_SUM, 0, Ranks::comm()); // where the others wait
  }
  static constexpr int ranks_of_one = 1;
};

int lead(const std::string &how)
{
  Team::use();
  const Team *team = Team::of_this_run();
  try
  {
    Trial trial{how};
    team->together(trial);
    std::cout << trial.sum << " ranks took part" << std::endl;
  }
  catch (const std::invalid_argument &error)
  {
    std::cout << "told: " << error.what() << std::endl;
  }
  Trial next{"sound"}; // after a failure all are on speaking terms
  team->together(next);
  std::cout << "then " << next.sum << " ranks took part" << std::endl;
  team->ranks().order(0);
  return 0;
}

void follow(const Ranks &ranks)
{
  while (ranks.next_order() != 0)
    try
    {
      Trial trial;
      Team::carry_out(trial, ranks);
    }
    catch (const gestell::fem::AgreedFailure &)
    {
    }
}

} // namespace

int main(int argc, char **argv)
{
  MPI_Init(&argc, &argv);
  const Ranks ranks;
  if (ranks.first())
    lead(argc > 1 ? argv[1] : "sound");
  else
    follow(ranks);
  MPI_Finalize();
  return 0;
}
