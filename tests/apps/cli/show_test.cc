// Pictures of results without ParaView, by the program.

#include "tests/support/program.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

const std::string head = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\">\n<Collection>\n";
const std::string tail = "</Collection>\n</VTKFile>\n";

std::string named(const Folder &folder)
{
  return "'" + folder.results().string() + "'";
}

/// A folder of results whose motion.pvd has this text.
void write_motion(const Folder &folder, const std::string &text)
{
  std::filesystem::create_directories(folder.results());
  std::ofstream(folder.results() / "motion.pvd") << text;
}

TEST(Show, RefusesAFolderWithoutResults)
{
  const Folder folder("show_nothing");
  expect_answer(gestell("show"), 2, {"needs the folder of a result"});
  expect_answer(gestell("show " + named(folder)), 2, {"is not a folder of results"});
  std::filesystem::create_directories(folder.results());
  expect_answer(gestell("show " + named(folder)), 2, {"contains no motion.pvd", "gestell modes"});
}

TEST(Show, RefusesABrokenCollectionWithTheFile)
{
  const Folder folder("show_broken");
  write_motion(folder, head);
  expect_answer(gestell("show " + named(folder)), 2, {"motion.pvd: is not a complete collection"});
  write_motion(folder, head + "<DataSet timestep=\"x\" part=\"0\" file=\"a.vtp\"/>\n" + tail);
  expect_answer(gestell("show " + named(folder)), 2, {"motion.pvd: broken", "timestep"});
  write_motion(folder, head + "<DataSet timestep=\"0\" part=\"0\" file=\"a.vtp\"/>\n" + tail);
  expect_answer(gestell("show " + named(folder)), 2, {"a.vtp: named in motion.pvd, is missing"});
  write_motion(folder, head + tail);
  expect_answer(gestell("show " + named(folder)), 2, {"has no data set"});
  expect_answer(gestell("show --width 10 " + named(folder)), 2, {"--width: from 200 to 4000"});
}

} // namespace
} // namespace gestell::tests
