// A case per process of a launcher: nothing is taken for the work of a team that is not.

#include "coupling/frame/frame_recipe.h"
#include "tests/support/program.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

namespace fs = std::filesystem;

const std::string program = "\"" GESTELL_BINARY_DIR "/bin/gestell\"";

/// A shell line on n ranks; $OMPI_COMM_WORLD_RANK is the number of each.
Answer on_ranks(int n, const std::string &line, const std::string &environment = "")
{
  return shell(environment +
               " OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 timeout 300 mpirun --oversubscribe "
               "--mca mpi_yield_when_idle 1 -np " +
               std::to_string(n) + " sh -c '" + line + "'");
}

/// A scene and a folder for each rank.
struct Cases
{
  explicit Cases(int n) : n(n)
  {
    for (int i = 0; i < n; ++i)
    {
      fs::create_directories(folder / ("in" + std::to_string(i)));
      folder.file("in" + std::to_string(i) + "/case.toml",
                  "name = 'case'\n[body.slide]\ntype = 'slider'\naxis = [1, 0, 0]\nmass = '" + std::to_string(i + 1) +
                      " kg'\n[element.spring]\ntype = 'spring-damper'\nfrom = 'slide'\nstiffness = '100 N/m'\n"
                      "[start]\nq = { slide = '1 mm' }\n[run]\nstep = '1 ms'\nend = '0.1 s'\n"
                      "[output]\nsignals = { x = 'slide.displacement' }\n");
    }
  }

  /// gestell run of the own case, into the own folder.
  std::string run(const std::string &options = "") const
  {
    const std::string own = (folder / "").string() + "in$OMPI_COMM_WORLD_RANK";
    return program + " run \"" + own + "/case.toml\" --quiet -o \"" + own + "/results\" " + options;
  }
  /// In the own folder, by the same words.
  std::string run_there() const
  {
    return "cd \"" + (folder / "").string() + "in$OMPI_COMM_WORLD_RANK\" && " + program +
           " run case.toml --quiet -o results";
  }

  int n_done() const
  {
    int done = 0;
    for (int i = 0; i < n; ++i)
      done += fs::exists(folder / ("in" + std::to_string(i)) / "results" / "summary.json");
    return done;
  }

  Folder folder{"cases_of_ranks"};
  int    n;
};

} // namespace

TEST(CasesOfRanks, AreRefusedAsATeamWithTheWayOut)
{
  for (const int n : {2, 4})
    for (const bool there : {false, true})
    {
      const Cases  cases(n);
      const Answer answer = on_ranks(n, there ? cases.run_there() : cases.run());
      const auto   others = std::to_string(n - 1) + " of " + std::to_string(n) +
                          " ranks were started with another command line or working";
      expect_answer(answer, 2, {"gestell: mpirun: " + others, "--apart (or GESTELL_APART=1)"});
      EXPECT_EQ(count(answer.text, "gestell: "), 1) << answer.text;
      EXPECT_EQ(cases.n_done(), 0);
    }
}

TEST(CasesOfRanks, AreAllMadeApart)
{
  for (const int n : {2, 4})
  {
    const Cases by_option(n), by_variable(n);
    expect_answer(on_ranks(n, by_option.run("--apart")), 0, {"report: "});
    EXPECT_EQ(by_option.n_done(), n);
    expect_answer(on_ranks(n, by_variable.run_there(), "GESTELL_APART=1"), 0, {"report: "});
    EXPECT_EQ(by_variable.n_done(), n);
  }
}

/// The program with other sources of frames: a copy in which their hash is another one.
TEST(Ranks, OfAnotherBuildAreRefused)
{
  const fs::path    built = GESTELL_BINARY_DIR "/bin";
  const std::string hash  = coupling::sources_of_frames().substr(0, 8); // compilers divide texts
  std::string       bytes = read(built / "gestell");
  ASSERT_NE(bytes.find(hash), std::string::npos);
  for (auto at = bytes.find(hash); at != std::string::npos; at = bytes.find(hash, at))
    bytes[at] = bytes[at] == 'a' ? 'b' : 'a';
  const Folder folder{"other_build"};
  folder.file("gestell", bytes);
  fs::permissions(folder / "gestell", fs::perms::owner_all);
  for (const char *library : {"libgestell_team.so", "libgestell_frame.so"})
    fs::create_symlink(built / library, folder / library);
  const Cases       cases(1);
  const std::string call = " run case.toml --quiet", other = "\"" + (folder / "gestell").string() + "\"" + call;
  expect_answer(on_ranks(2, "cd \"" + (cases.folder / "in0").string() +
                                "\" && if [ $OMPI_COMM_WORLD_RANK = 1 ]; then " + other + "; else " + program + call +
                                "; fi"),
                2, {"gestell: mpirun: 1 of 2 ranks run another build of gestell than rank 0; install the same"});
}

TEST(CasesOfRanks, OfStudiesAreRefusedToo)
{
  const Cases       cases(2);
  const std::string study =
      "[scene]\nfile = 'case.toml'\n[variables.h_run]\nkey = 'run.step'\nfrom = '0.1 ms'\nto = '1 ms'\n"
      "[outputs]\nx = 'signals.x.max'\n[design]\ntype = 'Sobol'\nruns = 4\n";
  for (const char *file : {"in0/s0.toml", "in1/s1.toml", "in0/both.toml"})
    cases.folder.file(file, study);
  const std::string in = (cases.folder / "").string() + "in", options = " --quiet -o \"" + in + "0/study\"";
  const Answer      other =
      on_ranks(2, program + " study \"" + in + "$OMPI_COMM_WORLD_RANK/s$OMPI_COMM_WORLD_RANK.toml\"" + options);
  expect_answer(other, 2, {"1 of 2 ranks were started with another command line"});
  EXPECT_EQ(count(other.text, "gestell: "), 1) << other.text;
  EXPECT_FALSE(fs::exists(cases.folder / "in0/study"));
  expect_answer(on_ranks(2, program + " study \"" + in + "0/both.toml\"" + options), 0, {"report: "});
  EXPECT_EQ(count(read(cases.folder / "in0/study/runs.csv"), ",done,"), 4);
}

TEST(CasesOfRanks, RanksWithoutWorkAreReported)
{
  const Folder folder("idle_ranks");
  const Answer run = on_ranks(2, program +
                                     " run \"" GESTELL_SOURCE_DIR "/apps/scenes/press_minimal.toml\" "
                                     "--set run.end=0.01 --quiet -o \"" +
                                     folder.results().string() + "\"");
  expect_answer(run, 0, {"gestell: ranks without work: 1 of 2; no frame had to be computed"});
  EXPECT_EQ(count(on_ranks(4, program + " help stiffness").text, "ranks without work: 3 of 4"), 1);
}

// As srun --mpi=none starts two tasks, and as sbatch starts a script and an array its tasks.
TEST(CasesOfRanks, TasksOfSlurmWithoutMpiAreRefusedAndThoseOfABatchScriptRun)
{
  const Cases       cases(1);
  const std::string job  = "SLURM_JOB_ID=7 SLURM_JOBID=7 SLURM_NTASKS=2 SLURM_NPROCS=2 SLURM_NODELIST=here ",
                    call = "OMPI_COMM_WORLD_RANK=0; " + cases.run();
  const auto task        = [&](const std::string &rank, const std::string &options = "")
  {
    return shell("unset GESTELL_APART; export " + job +
                 "SLURM_STEP_ID=0 SLURM_STEPID=0 SLURM_STEP_NUM_TASKS=2 SLURM_PROCID=" + rank +
                 " SLURM_LOCALID=" + rank + "; " + call + options);
  };
  expect_answer(task("0"), 2,
                {"gestell: srun: started 2 processes without a common MPI", "srun --mpi=pmix", "--apart"});
  EXPECT_EQ(task("1").exit_code, 2);
  EXPECT_EQ(cases.n_done(), 0);
  expect_answer(task("1", "--apart"), 0, {"report: "});
  EXPECT_EQ(cases.n_done(), 1);
  expect_answer(
      shell("export " + job + "SLURM_PROCID=0 SLURM_LOCALID=0 SLURM_ARRAY_TASK_ID=3 SLURM_ARRAY_JOB_ID=7; " + call), 0,
      {"report: "});
}

} // namespace gestell::tests
