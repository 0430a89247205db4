#include "coupling/integration/system/second_order_system.h"
#include "coupling/plugin/frame_service_loader.h"
#include "tests/support/lattice.h"
#include "tests/support/test.h"

namespace gestell
{
namespace
{

using test::frame_of;
using test::Lattice;

// This program links nothing heavy: what it does comes through the door of the plugin.

TEST(Plugin, ReducesAFrame)
{
  const auto                 frame = frame_of(Lattice());
  coupling::ReductionOptions options;
  options.n_modes = 8;
  std::vector<std::string> phases;
  const auto               reduced = coupling::frame_service().reduce(
                    frame, options, [&](const std::string &phase, double) { phases.push_back(phase); });
  EXPECT_EQ(reduced.omega0.size(), 8);
  EXPECT_EQ(reduced.n_interface, 12);
  EXPECT_FALSE(phases.empty());
}

TEST(Plugin, WrongInputCrossesTheBorderAsWhatItIs)
{
  coupling::ReductionOptions options;
  options.n_modes = 100000;
  EXPECT_THROW(coupling::frame_service().reduce(frame_of(Lattice()), options, {}), std::invalid_argument);
}

TEST(Plugin, FailedMethodsCrossTheBorderAsWhatTheyAre)
{
  auto frame                 = frame_of(Lattice());
  frame.M                    = 0. * frame.M;
  frame.M.coeffRef(100, 100) = 1.;
  coupling::ReductionOptions options;
  options.n_modes = 2;
  EXPECT_THROW(coupling::frame_service().reduce(frame, options, {}), coupling::ConvergenceFailure);
}

TEST(Plugin, LetsTheCallersOwnExceptionsThrough)
{
  struct Interrupted
  {
  };
  EXPECT_THROW(coupling::frame_service().reduce(frame_of(Lattice()), {},
                                                [](const std::string &, double) { throw Interrupted(); }),
               Interrupted);
}

} // namespace
} // namespace gestell
