// The program under mpirun: several ranks compute what one process does, and speak with one voice.

#include "coupling/frame/reduced_frame_file.h"
#include "tests/support/cached_frame.h"
#include "tests/support/program.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

/// mpirun refuses root and more ranks than cores unless it is told; waiting ranks leave the processor to others.
std::string ranks(int n)
{
  return "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 timeout 300 mpirun --oversubscribe "
         "--mca mpi_yield_when_idle 1 -np " +
         std::to_string(n) + " ";
}

/// Calls the program with a cache that lasts as long as the folder.
Answer call(const Folder &folder, const std::string &launcher, const std::string &arguments)
{
  return shell("GESTELL_CACHE='" + (folder / "cache").string() + "' " + launcher +
               "'" GESTELL_BINARY_DIR "/bin/gestell' " + arguments);
}

/// A scene of what the script of gmsh draws: clamped at x = 0, with an interface on the plane z = height.
std::string clamped(const Folder &folder, const std::string &script, const std::string &size, const std::string &height)
{
  folder.file("frame.geo", "SetFactory(\"OpenCASCADE\");\n" + script);
  return folder.file("scene.toml", "name = 'clamped'\n" +
                                       cad_frame("frame.geo", size, {{"damping", "{ ratio = 0.01 }"}}) +
                                       plane_surface("wall", "[-1, 0, 0]", "[0, 0, 0]") +
                                       plane_surface("pad", "[0, 0, 1]", "[0, 0, '" + height + "']") +
                                       table("frame.support.wall", {{"surfaces", "['wall']"}, {"clamped", "true"}}) +
                                       table("frame.interface.pad", {{"surfaces", "['pad']"}}) +
                                       table("reduction", {{"method", "craig-bampton"}, {"modes", "24"}}) +
                                       steps("0.1 ms", "1 ms") + "[output.signals]\nz = 'frame.pad.uz'\n");
}

/// A plate of 16 mm with a pad on it.
std::string plate(const Folder &folder, const std::string &size = "40 mm")
{
  return clamped(folder,
                 "Box(1) = {0, 0, 0, 0.8, 0.5, 0.016};\nBox(2) = {0.6, 0.2, 0.016, 0.1, 0.1, 0.02};\n"
                 "BooleanUnion{ Volume{1}; Delete; }{ Volume{2}; Delete; }\n",
                 size, "36 mm");
}

/// What the command `reduce` makes of a scene on n ranks; 0: without mpirun.
coupling::ReducedFrame reduced(const std::string &scene, int n)
{
  const Folder folder("mpi_" + std::to_string(n));
  const Answer answer = call(folder, n > 0 ? ranks(n) : "", "reduce " + scene + folder.option());
  EXPECT_EQ(answer.exit_code, 0) << answer.text;
  EXPECT_EQ(count(answer.text, "reduced frame created"), 1) << answer.text;
  return coupling::read_reduced_frame((folder.results() / "reduced_frame.h5").string());
}

/// Largest relative difference of frequencies: of the supported frame, and with the interface held.
double difference(const coupling::ReducedFrame &frame, const coupling::ReducedFrame &alone)
{
  EXPECT_EQ(frame.frequencies_hz.size(), alone.frequencies_hz.size());
  EXPECT_EQ(frame.omega0.size(), alone.omega0.size());
  EXPECT_GT(alone.frequencies_hz.minCoeff(), 0.);
  return std::max((frame.frequencies_hz.cwiseQuotient(alone.frequencies_hz).array() - 1.).abs().maxCoeff(),
                  (frame.omega0.cwiseQuotient(alone.omega0).array() - 1.).abs().maxCoeff());
}

/// What the frame says of its mesh, which another factor tells.
std::string judgement(const coupling::ReducedFrame &frame)
{
  for (const auto *texts : {&frame.notes, &frame.statements})
    for (const std::string &text : *texts)
      if (text.find("estimated by elements of degree three") != std::string::npos)
        return text;
  return "";
}

constexpr double same =
    1e-9; // rounding of factors made in another order, amplified by the condition of C22; 3e-12 is met

/// A block with a bore and a pad, whose cells have curved sides.
std::string bored(const Folder &folder)
{
  return clamped(folder,
                 "Box(1) = {0, 0, 0, 0.6, 0.3, 0.2};\nCylinder(2) = {0.3, 0.15, 0, 0, 0, 0.2, 0.08};\n"
                 "BooleanDifference{ Volume{1}; Delete; }{ Volume{2}; Delete; }\n"
                 "Box(3) = {0.45, 0.1, 0.2, 0.1, 0.1, 0.02};\n"
                 "BooleanUnion{ Volume{1}; Delete; }{ Volume{3}; Delete; }\n",
                 "60 mm", "220 mm");
}

const std::string curved      = " frame.mesh.curved=true",
                  coarse_size = " frame.mesh.size='\"250 mm\"' frame.mesh.'\"crown bearing *\"'='\"150 mm\"'";

/// Arguments of the command line for entries to set.
std::string set(const std::string &entries)
{
  std::string arguments = entries;
  for (auto at = arguments.find(" frame"); at != std::string::npos; at = arguments.find(" frame", at + 7))
    arguments.insert(at, " --set");
  return arguments + " ";
}

void expect_same_frequencies(const std::string &scene, int ranks)
{
  const auto   frame = reduced(scene, ranks), alone = reduced(scene, 0);
  const double found = difference(frame, alone);
  EXPECT_LT(found, same);
  EXPECT_EQ(judgement(frame), judgement(alone));
  EXPECT_NE(judgement(alone), "");
  ::testing::Test::RecordProperty("difference", std::to_string(found / same) + " of what is allowed");
}

using RanksOfMpi = ::testing::TestWithParam<int>;

TEST_P(RanksOfMpi, FindTheFrequenciesOfAPlateThatOneProcessFinds)
{
  const Folder folder("mpi_plate");
  expect_same_frequencies(plate(folder), GetParam());
}

TEST_P(RanksOfMpi, FindTheFrequenciesOfACurvedFrameThatOneProcessFinds)
{
  const Folder folder("mpi_curved");
  expect_same_frequencies(bored(folder) + set(curved), GetParam());
}

TEST(TwoRanksOfMpi, FindTheFrequenciesOfAPrestressedPlateThatOneProcessFinds)
{
  const Folder      folder("mpi_prestress");
  const std::string scene = plate(folder) + " --set frame.prestress='{ loads = [{ surface = \"pad\", force = [0, 0, "
                                            "\"-20 kN\"] }] }'";
  const auto        ranks = reduced(scene, 2), alone = reduced(scene, 0);
  EXPECT_LT(difference(ranks, alone), same);
  EXPECT_EQ(ranks.statements, alone.statements);
}

TEST(FourRanksOfMpi, FindTheFrequenciesOfThePressThatOneProcessFinds)
{
  expect_same_frequencies(scene("press.toml") + set(coarse_size), 4);
}

TEST(EightRanksOfMpi, FindTheFrequenciesOfAPlateThatOneProcessFinds)
{
  const Folder folder("mpi_plate");
  expect_same_frequencies(plate(folder), 8);
}

INSTANTIATE_TEST_SUITE_P(All, RanksOfMpi, ::testing::Values(1, 2, 4), ::testing::PrintToStringParamName());

TEST(Mpi, ARunFromTheCacheLoadsNothingOnAnyRankButMpi)
{
  const Folder      folder("mpi_cache");
  const std::string scene = plate(folder, "80 mm");
  ASSERT_EQ(call(folder, "", "reduce " + scene).exit_code, 0);
  const Answer answer = call(folder, ranks(2) + "-x LD_DEBUG=files ", "reduce " + scene);
  EXPECT_EQ(answer.exit_code, 0);
  EXPECT_EQ(count(answer.text, "reduced frame from the cache"), 1);
  ASSERT_TRUE(answer.says("libmpi.so"));
  for (const char *library : {"libgestell_frame", "libdeal", "libpetsc", "libslepc", "libgmsh", "libdmumps"})
    EXPECT_FALSE(answer.says(library)) << library;
}

TEST(Mpi, OfRanksOneReducesTheParts)
{
  const Folder folder("mpi_parts");
  const Answer answer = call(folder, ranks(2), "reduce " + plate(folder, "80 mm") + " --set frame.parts=2");
  EXPECT_EQ(answer.exit_code, 0) << answer.text;
  EXPECT_EQ(count(answer.text, "gestell: ranks without work while the parts are reduced: 1 of 2"), 1) << answer.text;
}

TEST(Mpi, AFactorOfOneProcessIsRefusedWhereAFrameIsComputed)
{
  const Folder      folder("mpi_factor");
  const std::string reduce  = "reduce " + plate(folder, "80 mm") + " --set reduction.factor=cholmod";
  const Answer      refused = call(folder, ranks(2), reduce);
  EXPECT_EQ(refused.exit_code, 2) << refused.text;
  EXPECT_EQ(count(refused.text, "is a factor of one process"), 1) << refused.text;
  ASSERT_EQ(call(folder, "", reduce).exit_code, 0);
  EXPECT_EQ(call(folder, ranks(2), reduce).exit_code, 0) << "a frame from the cache needs none";
}

TEST(Mpi, WrongInputIsReportedOnceAndEndsAllRanks)
{
  const Folder folder("mpi_wrong");
  const Answer answer = call(folder, ranks(2), "reduce " + plate(folder) + " --set reduction.modes=-3");
  EXPECT_EQ(answer.exit_code, 2) << answer.text;
  EXPECT_EQ(count(answer.text, "gestell: "), 1) << answer.text;
  EXPECT_EQ(count(call(folder, ranks(2), "dance").text, "there is no command 'dance'"), 1);
}

TEST(Mpi, AFrameWithALoosePartIsReportedOnceAndEndsAllRanks)
{
  const Folder      folder("mpi_loose");
  const std::string chain = "reduce " + folder.file("chain.toml", test::reduced_chain);
  EXPECT_EQ(call(folder, ranks(2), chain).exit_code, 0) << "three coordinates are enough for two ranks";
  // The lower two masses are joined to each other alone.
  const Answer answer =
      call(folder, ranks(2), chain + " --set frame.stiffness='[[1e6, -1e6, 0], [-1e6, 1e6, 0], [0, 0, 1e6]]'");
  EXPECT_EQ(answer.exit_code, 2) << answer.text;
  EXPECT_EQ(count(answer.text, "unconstrained with its interface fixed"), 1) << answer.text;
}

TEST(Mpi, KrylovSchurOfSlepcFindsTheSameFrequencies)
{
  const Folder      folder("mpi_slepc");
  const std::string scene = plate(folder);
  EXPECT_LT(difference(reduced(scene + " --set reduction.eigensolver=krylov-schur", 2), reduced(scene, 2)), same);
}

/// A cube of n x n x n hexahedra with its interface opposite to the wall.
std::string cube(const Folder &folder, int n)
{
  return clamped(folder,
                 "Box(1) = {0, 0, 0, 1, 1, 1};\nTransfinite Curve{:} = " + std::to_string(n + 1) +
                     ";\nTransfinite Surface{:};\nRecombine Surface{:};\nTransfinite Volume{1};\nMesh 3;\n",
                 "1 m", "1 m");
}
const std::string opposite = " frame.surface.pad.plane='{ normal = [1, 0, 0], through = [1, 0, 0] }'";

// The elimination of eight cells has fewer subtrees than there are ranks.
TEST(Mpi, RanksWithoutRowsTakePart)
{
  const Folder      folder("mpi_few");
  const std::string scene = cube(folder, 2) + set(opposite);
  EXPECT_LT(difference(reduced(scene, 5), reduced(scene, 0)), same);
}

TEST(Mpi, MoreRanksThanCellsAreRefused)
{
  const Folder folder("mpi_cells");
  const Answer answer = call(folder, ranks(2), "reduce " + cube(folder, 1) + set(opposite));
  EXPECT_EQ(answer.exit_code, 2) << answer.text;
  EXPECT_EQ(count(answer.text, "2 ranks for a frame of 1 cells"), 1) << answer.text;
}

TEST(Mpi, AnotherLauncherIsRefused)
{
  const Folder folder("mpi_other");
  // As an mpirun of another MPI would start two: each finds itself alone.
  const std::string other  = "PMI_SIZE=2 PMI_RANK=";
  const Answer      first  = call(folder, other + "0 ", "check " + scene("press.toml"));
  const Answer      second = call(folder, other + "1 ", "check " + scene("press.toml"));
  expect_answer(first, 2, {"belongs to an MPI other"});
  EXPECT_EQ(second.exit_code, 2);
  EXPECT_FALSE(second.says("gestell")) << second.text;
}

} // namespace
} // namespace gestell::tests
