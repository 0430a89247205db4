// Whose file is it: only what the list of a folder names is replaced or removed.

#include "apps/analysis/result_folder.h"
#include "apps/output/folder/own_folder.h"
#include "apps/output/folder/writing.h"
#include "coupling/frame/atomic_file.h"
#include "tests/support/output_example.h"
#include "tests/support/program.h"
#include "tests/support/refusal.h"

#include <utime.h>

namespace gestell
{
namespace
{

namespace fs = std::filesystem;
using apps::OwnFolder;
using tests::read;

class OwnFiles : public ::testing::Test
{
protected:
  void put(const std::string &name, const std::string &text = "of the user") const
  {
    fs::create_directories((folder / name).parent_path());
    std::ofstream(folder / name) << text;
  }
  std::string refused(const std::vector<std::string> &names, const std::vector<fs::path> &inputs = {}) const
  {
    return tests::refusal([&] { OwnFolder(folder / "").require_free(names, inputs); });
  }
  static void remove_all(const fs::path &path)
  {
    OwnFolder(path).remove_all([](const std::string &) { return true; });
  }

  tests::Folder folder = tests::Folder("own_files");
};

TEST_F(OwnFiles, AreThoseOfTheListAlone)
{
  OwnFolder own(folder / "");
  own.write("history.csv", "ours");
  own.write("charts/1.svg", "ours");
  put("notes.txt");
  put("charts/mine.svg");
  EXPECT_TRUE(OwnFolder(folder / "").owns("charts/1.svg"));
  EXPECT_FALSE(own.owns("notes.txt"));
  remove_all(folder / "");
  EXPECT_FALSE(fs::exists(folder / "history.csv"));
  EXPECT_FALSE(fs::exists(folder / "charts/1.svg"));
  EXPECT_EQ(read(folder / "notes.txt"), "of the user");
  EXPECT_EQ(read(folder / "charts/mine.svg"), "of the user");
}

// What the list named once and the user has put there since is the user's.
TEST_F(OwnFiles, AreForgottenWhenTheyAreRemoved)
{
  OwnFolder(folder / "").write("history.csv", "ours");
  remove_all(folder / "");
  put("history.csv");
  remove_all(folder / "");
  EXPECT_EQ(read(folder / "history.csv"), "of the user");
}

TEST_F(OwnFiles, AreInTheListBeforeTheyAppear)
{
  OwnFolder      own(folder / "");
  const fs::path place = own.claim("motion/frame_00001.vtp");
  EXPECT_FALSE(fs::exists(place));
  EXPECT_NE(read(folder / ".gestell-files").find("\nmotion/frame_00001.vtp\n"), std::string::npos);
}

TEST_F(OwnFiles, AreNotReachedThroughLinks)
{
  put("elsewhere/history.csv");
  put("elsewhere/1.svg");
  fs::create_directories(folder / "results");
  fs::create_directory_symlink(folder / "elsewhere", folder / "results/charts");
  fs::create_symlink(folder / "elsewhere/history.csv", folder / "results/history.csv");
  put("results/.gestell-files", "# Files that gestell wrote here: it replaces and removes no other files.\n"
                                "charts/1.svg\nhistory.csv\n");
  OwnFolder own(folder / "results");
  remove_all(folder / "results");
  EXPECT_THROW(own.write("charts/1.svg", "ours"), std::invalid_argument);
  EXPECT_THROW(own.write("history.csv", "ours"), std::invalid_argument);
  EXPECT_EQ(read(folder / "elsewhere/1.svg"), "of the user");
  EXPECT_EQ(read(folder / "elsewhere/history.csv"), "of the user");
  EXPECT_TRUE(fs::is_symlink(folder / "results/history.csv"));
}

TEST_F(OwnFiles, OfAForgedListStayInsideTheFolder)
{
  put("outside.txt");
  put("results/here.txt");
  const std::string absolute = (folder / "outside.txt").string();
  put("results/.gestell-files",
      "# Files that gestell wrote here: it replaces and removes no other files.\n../outside.txt\n" + absolute +
          "\n./here.txt\nx/../here.txt\n");
  remove_all(folder / "results");
  EXPECT_TRUE(fs::exists(folder / "outside.txt"));
  EXPECT_TRUE(fs::exists(folder / "results/here.txt"));
}

TEST_F(OwnFiles, OfAListThatIsNoneOfOursAreNone)
{
  put(".gestell-files", "history.csv\n");
  put("history.csv");
  remove_all(folder / "");
  EXPECT_TRUE(fs::exists(folder / "history.csv"));
  EXPECT_NE(refused({"chart.csv"}).find(".gestell-files is not a file list written by gestell"), std::string::npos);
  EXPECT_THROW(OwnFolder(folder / "").claim("chart.csv"), std::invalid_argument);
  EXPECT_EQ(read(folder / ".gestell-files"), "history.csv\n");
}

// A process was killed before it wrote the first line.
TEST_F(OwnFiles, OfAListWithoutALineBeginItAgain)
{
  put(".gestell-files", "");
  OwnFolder(folder / "").write("history.csv", "ours");
  EXPECT_TRUE(OwnFolder(folder / "").owns("history.csv"));
}

TEST_F(OwnFiles, ThatAUserPutInThePlaceOfOursRefuseTheCommandWithTheWayOut)
{
  put("history.csv");
  for (const char *word : {"history.csv was not written by gestell", "-o DIR"})
    EXPECT_NE(refused({"history.csv"}).find(word), std::string::npos) << refused({"history.csv"});
  EXPECT_EQ(refused({"summary.json", "charts/", "orbit_*.csv"}), "");
  put("orbit_2.csv");
  EXPECT_NE(refused({"orbit_*.csv"}).find("orbit_2.csv"), std::string::npos);
  put("charts");
  EXPECT_NE(refused({"charts/"}).find("charts is not a folder"), std::string::npos);
}

TEST_F(OwnFiles, ThatTheCommandReadsAreNotReplaced)
{
  OwnFolder(folder / "").write("history.csv", "t [s]\n");
  fs::create_symlink(folder / "history.csv", folder / "link.csv");
  EXPECT_EQ(refused({"history.csv"}), "");
  EXPECT_NE(refused({"history.csv"}, {folder / "history.csv"}).find("is an input of this command"), std::string::npos);
  EXPECT_NE(refused({"history.csv"}, {folder / "link.csv"}).find("is an input of this command"), std::string::npos);
  EXPECT_EQ(refused({"chart.csv"}, {folder / "history.csv"}), "");
}

// Left by a process that was killed an hour ago; a user's file that only begins alike stays.
TEST_F(OwnFiles, OfKilledProcessesAreRemovedAnHourLater)
{
  const utimbuf long_ago{1000000000, 1000000000};
  for (const char *name : {"unfinished-12-34", "unfinished-thesis.txt", "charts/unfinished-5-6"})
  {
    put(name);
    utime((folder / name).c_str(), &long_ago);
  }
  OwnFolder(folder / "").write("charts/1.svg", "ours");
  remove_all(folder / "");
  EXPECT_FALSE(fs::exists(folder / "unfinished-12-34"));
  EXPECT_FALSE(fs::exists(folder / "charts"));
  EXPECT_TRUE(fs::exists(folder / "unfinished-thesis.txt"));
}

TEST_F(OwnFiles, OfResultsAreJudgedBeforeAnythingIsRemoved)
{
  const apps::Result result = apps::example_result();
  apps::prepare_folder(folder / "");
  apps::write_results(folder / "", result);
  put("charts/mine.svg");
  apps::prepare_folder(folder / ""); // a second time into the same folder
  EXPECT_FALSE(fs::exists(folder / "summary.json"));
  EXPECT_TRUE(fs::exists(folder / "charts/mine.svg"));
  apps::write_results(folder / "", result);
  fs::remove(folder / ".gestell-files");
  EXPECT_NE(tests::refusal([&] { apps::prepare_folder(folder / ""); }).find("was not written by gestell"),
            std::string::npos);
  EXPECT_TRUE(fs::exists(folder / "summary.json"));
}

TEST_F(OwnFiles, OfACopiedFolderAreOursThere)
{
  OwnFolder(folder / "one").write("history.csv", "ours");
  fs::copy(folder / "one", folder / "two", fs::copy_options::recursive);
  EXPECT_TRUE(OwnFolder(folder / "two").owns("history.csv"));
}

// A file that cannot be written: the others are there, a series is there as a whole or not at all, and all of it is
// in the folder for temporary files.
TEST_F(OwnFiles, ThatCannotBeWrittenAreAllElsewhere)
{
  put("results/b.vtp"); // in the way of the second one of a series
  std::string where;
  const auto  write = [&](apps::Writing &writing)
  {
    writing.write("history.csv", "t [s]\n");
    writing.together(
        [](OwnFolder &own, std::vector<std::string> &names)
        {
          for (const char *name : {"a.vtp", "b.vtp"})
          {
            names.push_back(name);
            own.write(name, "ours");
          }
        });
    writing.write("summary.json", "{}\n");
  };
  const std::string message =
      tests::refusal<coupling::WriteFailure>([&] { apps::write_or_rescue(folder / "results", write); });
  EXPECT_NE(message.find("b.vtp was not written by gestell"), std::string::npos) << message;
  EXPECT_FALSE(fs::exists(folder / "results/a.vtp"));
  EXPECT_EQ(read(folder / "results/b.vtp"), "of the user");
  EXPECT_EQ(read(folder / "results/summary.json"), "{}\n");
  const auto begin = message.find("all results are in ") + 19, end = message.find(" instead");
  ASSERT_LT(begin, end) << message;
  const fs::path elsewhere = message.substr(begin, end - begin);
  for (const char *name : {"history.csv", "a.vtp", "b.vtp", "summary.json"})
    EXPECT_TRUE(fs::exists(elsewhere / name)) << name;
  fs::remove_all(elsewhere);
}

} // namespace
} // namespace gestell
