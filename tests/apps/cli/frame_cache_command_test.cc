// A frame that is asked for again, through the program: found, explained, listed, pruned, and without the heavy half.

#include "apps/session/prepared_machine.h"
#include "coupling/frame/frame_cache.h"
#include "tests/support/cached_frame.h"
#include "tests/support/program.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

class FrameCacheCommand : public ::testing::Test
{
protected:
  Folder      folder{"frame_cache_command"};
  std::string scene  = folder.file("chain.toml", test::reduced_chain);
  std::string cache  = (folder / "cache").string();
  std::string called = "GESTELL_CACHE='" + cache + "' '" GESTELL_BINARY_DIR "/bin/gestell' ";

  void SetUp() override
  {
    setenv("GESTELL_CACHE", cache.c_str(), 1);
    const auto origin = apps::frame_origin(apps::read_scene((folder / "chain.toml").string()));
    ASSERT_EQ(coupling::keep_in_cache(test::chain_frame(), origin), "");
  }
  void TearDown() override { unsetenv("GESTELL_CACHE"); }

  std::string kept() const { return std::filesystem::directory_iterator(cache)->path().string(); }
};

TEST_F(FrameCacheCommand, ARunFromItLoadsNoneOfTheHeavyLibraries)
{
  const Answer answer =
      shell("LD_DEBUG=files " + called + "run " + scene + folder.option() + "--set run.end='\"20 us\"'");
  ASSERT_EQ(answer.exit_code, 0) << answer.text;
  ASSERT_TRUE(answer.says("libc.so")) << "the loader tells its files";
  for (const char *library : {"libgestell_frame", "libdeal", "libpetsc", "libslepc", "libgmsh", "libTK"})
    EXPECT_FALSE(answer.says(library)) << library;
  if (!answer.says("libsundials_core")) // of version 7, which Debian builds with MPI
    EXPECT_FALSE(answer.says("libmpi"));
}

TEST_F(FrameCacheCommand, MovesAsTheFrameItIsFrom)
{
  const Answer reduced = shell(called + "run " + scene + folder.option());
  ASSERT_EQ(reduced.exit_code, 0) << reduced.text;
  const auto   final_x = [&] { return json_number(read(folder.results() / "summary.json"), {"signals", "final"}); };
  const double x       = final_x();
  const Answer whole   = shell(called + "run " + scene + folder.option() + "--set reduction.method='\"none\"'");
  ASSERT_EQ(whole.exit_code, 0) << whole.text;
  EXPECT_NEAR(x, final_x(), 1e-4 * std::abs(x)); // the cached one has a damping of 1e-4/s for 0.1 s
}

TEST_F(FrameCacheCommand, ExplainsHitAndMiss)
{
  expect_answer(shell(called + "reduce --explain " + scene), 0, {"is in the cache and would be used"});

  expect_answer(shell(called + "reduce --explain " + scene + " --set reduction.modes=1"), 0,
                {"is not in the cache", "reduction.modes: cached 2, requested 1"});

  std::filesystem::resize_file(kept(), 1000);
  const Answer damaged = shell(called + "reduce --explain " + scene);
  EXPECT_TRUE(damaged.says("is damaged")) << damaged.text;
}

TEST_F(FrameCacheCommand, NamesChoicesAsScenesDo)
{
  folder.file("block.geo", "SetFactory(\"OpenCASCADE\");\nBox(1) = {0, 0, 0, 1, 1, 1};\n");
  const std::string block = folder.file(
      "block.toml", "name = 'block'\n" +
                        table("frame", {{"cad", "block.geo"}, {"unit", "1 m"}, {"mesh", "{ size = '0.5 m' }"}}) +
                        plane_surface("top", "[0, 0, 1]", "[0, 0, 1]") +
                        table("frame.interface.top", {{"surface", "top"}}) + table("reduction", {{"modes", "2"}}));
  const auto origin = apps::frame_origin(apps::read_scene((folder / "block.toml").string()));
  ASSERT_EQ(coupling::keep_in_cache(test::chain_frame(), origin), "");
  const Answer miss = shell(called + "reduce --explain " + block +
                            " --set frame.interface.top.coupling='\"average\"' "
                            "--set reduction.inside='\"free-interface\"' --set frame.mesh.overlaps='\"once\"'");
  for (const char *part :
       {"interface.1.coupling: cached rigid, requested average\n", "mesh.overlaps: cached refused, requested once\n",
        "reduction.method: cached craig-bampton, requested free-interface\n"})
    EXPECT_TRUE(miss.says(part)) << miss.text;
}

TEST_F(FrameCacheCommand, ListsAndPrunesWhatIsAskedForOnly)
{
  const Answer list = shell(called + "reduce --list");
  expect_answer(list, 0, {"1 file", "3 -> 1 + 2 modes", "chain.toml"});

  std::ofstream(cache + "/notes.txt") << "of the user";
  for (const std::string option : {"", " --older-than '1 d'", " --larger-than '1 GB'"})
    EXPECT_TRUE(shell(called + "reduce --prune" + option).says("removed 0 files")) << option;
  EXPECT_TRUE(shell(called + "reduce --prune --larger-than '1 kB'").says("removed 1 file,"));
  EXPECT_TRUE(std::filesystem::exists(cache + "/notes.txt"));
  EXPECT_TRUE(shell(called + "reduce --list").says("0 files"));
}

TEST_F(FrameCacheCommand, TellsFramesOfOneSceneApart)
{
  EXPECT_FALSE(shell(called + "reduce --list").says("reduction.modes"));
  const auto origin = apps::frame_origin(apps::read_scene((folder / "chain.toml").string(), {"reduction.modes=1"}));
  ASSERT_EQ(coupling::keep_in_cache(test::chain_frame(), origin), "");
  const Answer list = shell(called + "reduce --list");
  EXPECT_TRUE(list.says("reduction.modes 2\n")) << list.text;
  EXPECT_TRUE(list.says("reduction.modes 1\n")) << list.text;
}

TEST_F(FrameCacheCommand, ChecksContentsIfAskedTo)
{
  EXPECT_TRUE(
      shell(called + "reduce --list --check").says("checked: 1 file read whole, against checksum and key; all"));
  {
    std::fstream change(kept(), std::ios::in | std::ios::out | std::ios::binary);
    change.seekg(-8, std::ios::end);
    const char last = char(change.peek());
    change.seekp(-8, std::ios::end);
    change.put(char(last + 1));
  }
  EXPECT_TRUE(shell(called + "reduce --prune").says("removed 0 files"));
  EXPECT_TRUE(shell(called + "reduce --list --check").says("; 1 cannot be used"));
  EXPECT_TRUE(shell(called + "reduce --explain " + scene).says("would be reduced again"));
  EXPECT_TRUE(shell(called + "reduce --prune --check").says("removed 1 file,"));
}

TEST_F(FrameCacheCommand, RefusesWhatCannotBeMeant)
{
  const auto says = [&](const std::string &arguments, const std::string &words)
  { expect_answer(shell(called + arguments), 2, {words}); };
  says("reduce", "the scene is missing");
  says("reduce --all", "add it");
  says("reduce --check", "--list or --prune");
  says("reduce --prune --older-than '3 parsecs'", "one of the units d, h, min, s, w");
  says("reduce --prune --larger-than many", "one of the units");
  says("reduce --list " + scene, "; remove ");
  EXPECT_TRUE(std::filesystem::exists(kept()));
}

TEST_F(FrameCacheCommand, ThatCannotKeepAFrameIsReportedButNotInTheFrameThatIsPassedOn)
{
  const auto        frame  = [&] { return read(folder.results() / "reduced_frame.h5"); };
  const std::string reduce = "reduce " + scene + folder.option() + "--set reduction.modes=1";
  expect_answer(shell(called + reduce), 0, {"reduced frame created"});
  const std::string kept = frame();
  expect_answer(shell("GESTELL_CACHE=/dev/null '" GESTELL_BINARY_DIR "/bin/gestell' " + reduce), 0,
                {"reduced frame created", "note: cache: the reduced frame is not stored"});
  EXPECT_TRUE(frame() == kept);
}

TEST_F(FrameCacheCommand, KeepsFramesThatCannotBeTriedInAChild)
{
  const Answer answer = shell("TMPDIR=/no/such/folder " + called + "reduce --prune");
  expect_answer(answer, 0, {"removed 0 files"});
}

TEST_F(FrameCacheCommand, WithoutAFolderIsEmpty)
{
  expect_answer(shell("GESTELL_CACHE='" + cache + "/absent' '" GESTELL_BINARY_DIR "/bin/gestell' reduce --list"), 0,
                {"0 files"});
}

} // namespace
} // namespace gestell::tests
