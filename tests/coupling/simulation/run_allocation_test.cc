// A run takes no memory from step to step: what it needs is there before the first one.

#include "mechanism/elements/cubic_spring.h"
#include "tests/support/jointed_machines.h"
#include "tests/support/methods.h"
#include "tests/support/test.h"

namespace
{
long allocations = 0;
} // namespace

// Eigen and operator new both take their memory by malloc; glibc keeps its own under another name.
extern "C" void                                        *__libc_malloc(std::size_t size);
extern "C" __attribute__((visibility("default"))) void *malloc(std::size_t size)
{
  ++allocations;
  return __libc_malloc(size);
}

namespace
{

using namespace gestell;
using namespace gestell::coupling;

/// Two masses on springs, one of them hardening, shaken; events none.
long allocations_of_run(const MethodOptions &method, double end, bool energy)
{
  MachineModel model;
  const int    x = model.add_slider("x", {1., 0., 0.}, 3., "ground"),
            y    = model.add_slider("y", {1., 0., 0.}, 2., "ground");
  model.add_linear("base", {{x, 1.}}, {2e4, 20., 0., 0.}, "N");
  model.add_linear("link", {{x, 1.}, {y, -1.}}, {3e4, 20., 0., 0.}, "N");
  model.attach("buffer", std::make_shared<mechanism::CubicSpring>(mechanism::CubicSpring::Parameters{1e4, 1e9}),
               {{{y, 1.}}});
  model.add_load("shaker", {{y, 1.}}, 0., {{60., 100., 0.}}, "N");
  Machine            machine(std::move(model));
  const InitialState rest           = tests::at_rest(machine);
  RunOptions         options        = tests::run_of(method, end);
  options.energy                    = energy;
  const std::vector<Signal> signals = {machine.signal("x", "x.displacement"), machine.signal("F", "buffer.force")};
  const long                before  = allocations;
  const RunResult           result  = simulate(machine, rest, options, signals);
  const long                needed  = allocations - before;
  EXPECT_EQ(result.failure, "");
  return needed;
}

/// Two swinging four-bars, the force of a foot as a signal.
long allocations_of_joints(const MethodOptions &method, double end)
{
  Machine                   machine = tests::n_four_bar(2);
  const Eigen::VectorXd     q       = Eigen::VectorXd::Zero(machine.size());
  const InitialState        start{0., q, tests::swinging_four_bars(machine)};
  RunOptions                options = tests::run_of(method, end);
  const std::vector<Signal> signals = {machine.signal("F", "foot 0.resultant")};
  const long                before  = allocations;
  const RunResult           result  = simulate(machine, start, options, signals);
  const long                needed  = allocations - before;
  EXPECT_EQ(result.failure, "");
  return needed;
}

TEST(Allocations, ForcesOfJointsAreNone)
{
  for (const std::string kind : {"bdf", "generalised-alpha"})
  {
    const MethodOptions method = tests::method(kind, 1e-3);
    allocations_of_joints(method, 0.1);
    EXPECT_EQ(allocations_of_joints(method, 0.2), allocations_of_joints(method, 0.4)) << kind;
  }
}

using RunAllocation = ::testing::TestWithParam<MethodOptions>;

TEST_P(RunAllocation, DoesNotGrowWithTheNumberOfSteps)
{
  allocations_of_run(GetParam(), 0.1, true); // tables of methods are made once in a program
  for (const bool energy : {false, true})
    EXPECT_EQ(allocations_of_run(GetParam(), 0.2, energy), allocations_of_run(GetParam(), 0.4, energy));
}

INSTANTIATE_TEST_SUITE_P(Methods, RunAllocation,
                         ::testing::Values(tests::method("bdf", 1e-4), tests::method("newmark", 1e-4),
                                           tests::method("wilson", 1e-4), tests::method("generalised-alpha", 1e-4),
                                           tests::method("exact", 1e-4)),
                         [](const auto &information)
                         {
                           std::string name = information.param.method;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST(Allocations, AreCounted)
{
  const long             before = allocations;
  const Eigen::VectorXd  x      = Eigen::VectorXd::Ones(100);
  const std::vector<int> y(100, 3);
  EXPECT_GE(allocations - before, 2);
  EXPECT_EQ(x.sum() + y[0], 103.);
}

} // namespace
