#include "coupling/frame/cache_folder.h"
#include "coupling/frame/frame_cache.h"
#include "fem/process/cpu_time.h"

#include "tests/support/frame_folder.h"
#include "tests/support/test.h"

#include <csignal>

#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utime.h>

namespace gestell
{
namespace
{

namespace fs = std::filesystem;
using coupling::cache_file;
using coupling::content_key;
using coupling::FrameOrigin;
using test::some_frame;

const FrameOrigin fine{{{"mesh.size", "0.04"}, {"material.E", "2.1e+11"}}, "fine.toml", "press.step"};
const FrameOrigin coarse{{{"mesh.size", "0.08"}, {"material.E", "2.1e+11"}}, "coarse.toml", "press.step"};
const FrameOrigin other{{{"mesh.size", "0.05"}, {"material.E", "7e+10"}}, "other.toml", "press.step"};

class FrameCache : public test::FrameFolder
{
};

TEST_F(FrameCache, FindsAFrameByItsKeyAlone)
{
  std::string       note;
  const std::string key = content_key(fine.recipe);
  EXPECT_FALSE(coupling::find_in_cache(key, note));
  EXPECT_EQ(note, "");
  EXPECT_EQ(coupling::keep_in_cache(some_frame(), fine), "");
  EXPECT_TRUE(coupling::find_in_cache(key, note));
  EXPECT_EQ(note, "");

  fs::rename(cache_file(key), cache_file(content_key(coarse.recipe))); // by someone who tidies up
  EXPECT_FALSE(coupling::find_in_cache(content_key(coarse.recipe), note));
  EXPECT_NE(note.find("other inputs"), std::string::npos) << note;
}

TEST_F(FrameCache, MakesAFrameOnceAndAgainWhereTheKeptOneIsDamaged)
{
  int        n_made = 0;
  const auto make   = [&]
  {
    ++n_made;
    return some_frame();
  };
  EXPECT_FALSE(coupling::cached_or_made(fine, make).from_cache);
  const coupling::CachedFrame kept = coupling::cached_or_made(fine, make);
  EXPECT_TRUE(kept.from_cache);
  EXPECT_TRUE(kept.frame.cache_notes.empty());
  EXPECT_EQ(n_made, 1);

  fs::resize_file(cache_file(content_key(fine.recipe)), 1000);
  const coupling::CachedFrame anew = coupling::cached_or_made(fine, make);
  EXPECT_FALSE(anew.from_cache);
  ASSERT_EQ(anew.frame.cache_notes.size(), 1u);
  EXPECT_NE(anew.frame.cache_notes[0].find("reduced again"), std::string::npos) << anew.frame.cache_notes[0];
  EXPECT_TRUE(coupling::cached_or_made(fine, make).from_cache);

  const auto fail = []() -> coupling::ReducedFrame { throw std::runtime_error("no frame"); };
  EXPECT_THROW(coupling::cached_or_made(coarse, fail), std::runtime_error);
  EXPECT_FALSE(fs::exists(cache_file(content_key(coarse.recipe))));
}

namespace
{

/// Takes this much processor time, at least.
coupling::ReducedFrame after_work(double seconds)
{
  const double begin = fem::cpu_time();
  while (fem::cpu_time() - begin < seconds)
  {
  }
  return some_frame();
}

} // namespace

TEST_F(FrameCache, KeepsTheProcessorTimeOfTheMaking)
{
  constexpr double work  = 0.1; // [s] long beside the ticks of the system's clock
  const auto       make  = [&] { return after_work(work); };
  const double     spent = coupling::cpu_time_without_cache() - fem::cpu_time();
  const auto       made  = coupling::cached_or_made(fine, make);
  EXPECT_GE(made.cpu, work);
  for (int i = 0; i < 2; ++i)
    EXPECT_EQ(coupling::cached_or_made(fine, make).cpu, made.cpu);
  const double saved = coupling::cpu_time_without_cache() - fem::cpu_time() - spent;
  EXPECT_LT(saved, work) << "made by this process: nothing is saved";
}

TEST_F(FrameCache, CountsAFrameOfAnotherProcessOnceWithItsProcessorTime)
{
  coupling::FrameOrigin origin = fine;
  origin.recipe.push_back({"by", "another process"});
  origin.cpu = 1000.;
  ASSERT_EQ(coupling::keep_in_cache(some_frame(), origin), "");
  const auto   make   = []() -> coupling::ReducedFrame { throw std::logic_error("it is there"); };
  const auto   saved  = [] { return coupling::cpu_time_without_cache() - fem::cpu_time(); };
  const double before = saved();
  for (int i = 0; i < 2; ++i)
  {
    EXPECT_EQ(coupling::cached_or_made(origin, make).cpu, origin.cpu);
    EXPECT_NEAR(saved() - before, origin.cpu, 1.); // two clocks are read one after the other
  }

  origin.recipe.push_back({"of", "parts"});
  const auto of_parts = [&]
  {
    coupling::FrameOrigin part = fine;
    part.recipe.push_back({"part", "found"});
    part.cpu = 500.;
    EXPECT_EQ(coupling::keep_in_cache(some_frame(), part), "");
    return coupling::cached_or_made(part, make).frame;
  };
  EXPECT_NEAR(coupling::cached_or_made(origin, of_parts).cpu, 500., 1.) << "a part that was found costs what it cost";
}

TEST_F(FrameCache, ThatCannotBeWrittenIsReportedAndDoesNoHarm)
{
  std::ofstream(folder / "file") << "no folder";
  setenv("GESTELL_CACHE", (folder / "file").c_str(), 1);
  EXPECT_NE(coupling::keep_in_cache(some_frame(), fine), "");
  EXPECT_TRUE(coupling::cache_entries().empty());
}

TEST_F(FrameCache, OnAFullDiskIsReportedAndLeavesNothing)
{
  // A process of its own, whose files may not grow beyond 4096 bytes: what a full disk looks like from inside.
  const pid_t child = fork();
  if (child == 0)
  {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{4096, 4096};
    setrlimit(RLIMIT_FSIZE, &limit);
    const std::string reason = coupling::keep_in_cache(some_frame(), fine);
    std::exit(reason.find("not stored") == std::string::npos ? 1 : 0); // HDF5 ends without complaint, too
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
  EXPECT_TRUE(fs::is_empty(folder));
}

TEST_F(FrameCache, ManyProcessesMayWriteTheSameFrame)
{
  constexpr int      writers = 4;
  std::vector<pid_t> children;
  for (int i = 0; i < writers; ++i)
  {
    children.push_back(fork());
    if (children.back() == 0)
    {
      std::string note, reported;
      for (int round = 0; round < 20; ++round)
      {
        reported += coupling::keep_in_cache(some_frame(), fine);
        if (!coupling::find_in_cache(content_key(fine.recipe), note))
          note += "not there";
      }
      _exit(reported.empty() && note.empty() ? 0 : 1);
    }
  }
  for (const pid_t child : children)
  {
    int status = 1;
    waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1); // no pieces are left
}

TEST_F(FrameCache, ListsFramesWithTheirOriginAndReportsWhichCannotBeUsed)
{
  coupling::keep_in_cache(some_frame(), fine);
  coupling::keep_in_cache(some_frame(), coarse);
  const utimbuf long_ago{1000000000, 1000000000};
  utime(cache_file(content_key(coarse.recipe)).c_str(), &long_ago);
  std::ofstream(folder / "notes.txt") << "of a user";
  std::ofstream(folder / (std::string(64, 'a') + ".h5")) << "foreign";
  std::ofstream(folder / "unfinished-1-2") << "being written by another process";
  std::ofstream(folder / "unfinished-3-4") << "of a process that was killed";
  utime((folder / "unfinished-3-4").c_str(), &long_ago);

  const auto entries = coupling::cache_entries();
  ASSERT_EQ(entries.size(), 4u);
  int usable = 0;
  for (const auto &entry : entries)
    if (entry.defect.empty())
    {
      ++usable;
      EXPECT_EQ(entry.key, content_key(entry.origin.recipe));
      EXPECT_EQ(entry.n_full, 150000);
      EXPECT_EQ(entry.n_interface, 3);
      EXPECT_EQ(entry.n_modes, 2);
      EXPECT_EQ(entry.bytes, fs::file_size(entry.file));
    }
  EXPECT_EQ(usable, 2);

  std::string note; // use makes a frame young again
  EXPECT_TRUE(coupling::find_in_cache(content_key(coarse.recipe), note));
  for (const auto &entry : coupling::cache_entries())
    if (entry.defect.empty())
    {
      EXPECT_GT(entry.last_used, 1500000000);
    }
}

/// Bytes that this process has read so far, as Linux counts them.
long bytes_read()
{
  std::ifstream io("/proc/self/io");
  std::string   name;
  long          count = -1;
  io >> name >> count; // "rchar: 123"
  return count;
}

TEST_F(FrameCache, IsListedWithoutReadingItsFramesWhole)
{
  auto frame  = some_frame();
  frame.notes = {std::string(20'000'000, 'x')};
  coupling::keep_in_cache(frame, fine);
  const std::string file  = cache_file(content_key(fine.recipe));
  const long        begin = bytes_read();
  ASSERT_GE(begin, 0);
  const auto entries = coupling::cache_entries();
  EXPECT_LT(bytes_read() - begin, 2'000'000) << "of " << fs::file_size(file);
  ASSERT_EQ(entries.size(), 1u);
  EXPECT_EQ(entries[0].defect, "");
  EXPECT_EQ(entries[0].n_full, 150000);

  // Damage of the numbers is seen where a frame is used, and where all is checked.
  {
    std::fstream change(file, std::ios::in | std::ios::out | std::ios::binary);
    change.seekp(std::streamoff(fs::file_size(file) / 2));
    change.put('y');
  }
  EXPECT_EQ(coupling::cache_entries()[0].defect, "");
  EXPECT_NE(coupling::content_defect(coupling::cache_entries()[0]).find("checksum"), std::string::npos);
  EXPECT_NE(coupling::cache_entries(coupling::CacheCheck::contents)[0].defect.find("checksum"), std::string::npos);
  std::string note;
  EXPECT_FALSE(coupling::find_in_cache(content_key(fine.recipe), note));

  fs::resize_file(file, fs::file_size(file) / 2); // cut off: HDF5 knows its end
  EXPECT_NE(coupling::cache_entries()[0].defect.find("is damaged"), std::string::npos);
}

TEST_F(FrameCache, NearestIsTheFrameOfTheFewestDifferences)
{
  EXPECT_FALSE(coupling::nearest_entry(coupling::cache_entries(), fine.recipe));
  coupling::keep_in_cache(some_frame(), coarse);
  coupling::keep_in_cache(some_frame(), other);
  const auto nearest = coupling::nearest_entry(coupling::cache_entries(), fine.recipe);
  ASSERT_TRUE(nearest);
  EXPECT_EQ(nearest->origin.scene, "coarse.toml");
}

TEST_F(FrameCache, FolderFollowsTheEnvironment)
{
  EXPECT_EQ(coupling::cache_folder(), folder.string());
  unsetenv("GESTELL_CACHE");
  setenv("XDG_CACHE_HOME", "/somewhere", 1);
  EXPECT_EQ(coupling::cache_folder(), "/somewhere/gestell");
  unsetenv("XDG_CACHE_HOME");
  setenv("HOME", "/of/somebody", 1);
  EXPECT_EQ(coupling::cache_folder(), "/of/somebody/.cache/gestell");
  unsetenv("HOME"); // never a folder that all users share
  EXPECT_EQ(coupling::cache_folder().find(fs::temp_directory_path().string()), std::string::npos);
}

/// Changes the mode of a file or folder while it lives.
class WithMode
{
public:
  WithMode(const fs::path &path, fs::perms mode) : path_(path), before_(fs::status(path).permissions())
  {
    fs::permissions(path, mode);
  }
  ~WithMode() { fs::permissions(path_, before_); }

private:
  fs::path  path_;
  fs::perms before_;
};

TEST_F(FrameCache, IsNotReadWhereOthersMayHaveWritten)
{
  const std::string key = content_key(fine.recipe);
  ASSERT_EQ(coupling::keep_in_cache(some_frame(), fine), "");
  const auto note_of_search = [&]
  {
    std::string note;
    return coupling::find_in_cache(key, note) ? "found" : note;
  };
  EXPECT_EQ(note_of_search(), "found");
  {
    const WithMode open(cache_file(key), fs::perms(0664));
    EXPECT_NE(note_of_search().find("can be written by its group"), std::string::npos) << note_of_search();
    EXPECT_NE(coupling::cache_entries().front().defect, "");
  }
  {
    const WithMode open(folder, fs::perms(0777));
    EXPECT_NE(note_of_search().find("can be written by every user"), std::string::npos) << note_of_search();
    EXPECT_NE(coupling::keep_in_cache(some_frame(), coarse).find("GESTELL_CACHE"), std::string::npos);
  }
  {
    const WithMode each_their_own(folder, fs::perms(01777));
    EXPECT_EQ(note_of_search(), "found");
  }
  if (chown(cache_file(key).c_str(), 12345, gid_t(-1)) != 0)
    return; // only root can give a file away
  EXPECT_NE(note_of_search().find("belongs to another user (uid 12345)"), std::string::npos) << note_of_search();
}

TEST_F(FrameCache, IsWrittenForThisUserAlone)
{
  setenv("GESTELL_CACHE", (folder / "new" / "cache").c_str(), 1);
  const mode_t before = umask(0);
  const auto   kept   = coupling::keep_in_cache(some_frame(), fine);
  umask(before);
  EXPECT_EQ(kept, "");
  EXPECT_EQ(coupling::foreign((folder / "new" / "cache").string()), "");
  EXPECT_EQ(coupling::foreign(cache_file(content_key(fine.recipe))), "");
}

TEST_F(FrameCache, KeepsNoFrameThatMoreThanFilesDecides)
{
  FrameOrigin beyond = fine;
  beyond.recipe.push_back({"part.column.beyond its files", "frame.geo:3: contains GetEnv"});
  EXPECT_NE(coupling::keep_in_cache(some_frame(), beyond).find("frame.geo:3"), std::string::npos);
  EXPECT_TRUE(coupling::cache_entries().empty());
}

} // namespace
} // namespace gestell
