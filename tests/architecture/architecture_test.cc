// The shape of the house (README, docs/develop/architecture.md) as theorems about its source text.

#include "tests/architecture/source_tree.h"
#include "tests/support/test.h"

namespace
{

using namespace gestell::tests;

/// Libraries of the heavy half, by the beginning of their headers' names.
const std::string heavy = "deal\\.II/|petsc|slepc|gmsh|mpi";

const std::vector<SourceFile> &tree()
{
  static const std::vector<SourceFile> files = read_source_tree(GESTELL_SOURCE_DIR);
  return files;
}

const std::vector<std::string> everywhere = {""};

/// Passes if nothing was found; else lists the findings.
::testing::AssertionResult none(const std::vector<std::string> &findings)
{
  auto result = findings.empty() ? ::testing::AssertionSuccess() : ::testing::AssertionFailure();
  for (const auto &finding : findings)
    result << "\n  " << finding;
  return result;
}

/// Lines of the file at `path`; none if there is no such file.
std::vector<std::string> lines_of(const std::string &path)
{
  for (const auto &file : tree())
    if (file.path == path)
      return file.lines;
  return {};
}

/// First group of `pattern` on the first line of the file at `path` that matches; empty if none does.
std::string first_match(const std::string &path, const std::string &pattern)
{
  const std::regex expression(pattern);
  for (const auto &line : lines_of(path))
    if (std::smatch match; std::regex_search(line, match, expression))
      return match[1];
  return "";
}

} // namespace

TEST(Search, FindsAnIncludeAgainstTheDirection)
{
  const std::vector<SourceFile> house = {{"fem/a.cc", {"// frame", " #  include \"mechanism/law.h\""}},
                                         {"fem/b.cc", {"#include \"fem/a.h\"", "#include <mechanism_like.h>"}},
                                         {"apps/c.cc", {"#include \"mechanism/law.h\""}}};

  EXPECT_EQ(includes_matching(house, {"fem/"}, {}, "mechanism/"),
            std::vector<std::string>{"fem/a.cc:2:  #  include \"mechanism/law.h\""});
  EXPECT_TRUE(none(includes_matching(house, {"fem/"}, {"fem/a"}, "mechanism/")));
}

TEST(Search, SeesTheWholeHouse)
{
  for (const std::string folder : {"fem/", "mechanism/", "coupling/", "apps/", "tests/"})
    EXPECT_GT(std::count_if(tree().begin(), tree().end(),
                            [&](const auto &file) { return file.path.compare(0, folder.size(), folder) == 0; }),
              2)
        << folder;
  EXPECT_FALSE(includes_matching(tree(), {"coupling/"}, {}, "fem/").empty()) << "coupling is built on fem's values";
}

TEST(Includes, OfScenesGoDownFromTheMachineToTheLanguage)
{
  const std::vector<std::string> folders = {"language/", "file/", "values/", "read/", "elements/", "scene", "build/"};
  for (std::size_t i = 0; i < folders.size(); ++i)
    for (std::size_t j = i + 1; j < folders.size(); ++j)
      EXPECT_TRUE(none(includes_matching(tree(), {"apps/scene/" + folders[i]}, {}, "apps/scene/" + folders[j])));
  EXPECT_TRUE(none(includes_matching(tree(), {"apps/scene/"}, {}, "apps/(?!scene/)")));
  EXPECT_TRUE(none(includes_matching(tree(), {"apps/fmu/"}, {}, "apps/(?!fmu/|scene/|output/values/)")));
}

TEST(Includes, OfOutputGoDownFromTheFolderToTheText)
{
  const std::vector<std::string> folders = {"text/",   "folder/",      "values/", "tables/",  "pictures/",
                                            "charts/", "interactive/", "report/", "paraview/"};
  for (std::size_t i = 0; i < folders.size(); ++i)
    for (std::size_t j = i + 1; j < folders.size(); ++j)
      EXPECT_TRUE(none(includes_matching(tree(), {"apps/output/" + folders[i]}, {}, "apps/output/" + folders[j])));
  EXPECT_TRUE(none(includes_matching(tree(), {"apps/output/"}, {}, "apps/(?!output/)")));
}

TEST(Includes, OfAnAnalysisStayBelowTheCommandsAndInItsFolder)
{
  EXPECT_TRUE(none(includes_matching(tree(), {"apps/analysis/"}, {},
                                     "apps/(?!analysis/|sizing/|session/|scene/|output/)|pybind11/|iostream")));
  std::set<std::string> folders;
  for (const SourceFile &file : tree())
    if (std::smatch found; std::regex_match(file.path, found, std::regex("apps/analysis/(\\w+)/.*")))
      folders.insert(found[1]);
  EXPECT_GT(folders.size(), 3u);
  // What is given out of an analysis: the linear machine to Python, the budget of the model that `size` has chosen.
  const std::vector<std::string> given_out = {"apps/python/python_scene", "apps/cli/size.cc"};
  for (const std::string &folder : folders)
  {
    std::vector<std::string> without = given_out;
    without.push_back("apps/analysis/" + folder + "/");
    EXPECT_TRUE(none(includes_matching(tree(), {"apps/"}, without, "apps/analysis/" + folder + "/"))) << folder;
  }
}

TEST(Includes, OfFemStayWithinFem)
{
  EXPECT_TRUE(none(includes_matching(tree(), {"fem/"}, {}, "mechanism/|coupling/|apps/|tests/")));
}

TEST(Includes, OfMechanismStayWithinMechanismAndEigen)
{
  EXPECT_TRUE(none(includes_matching(tree(), {"mechanism/"}, {}, "fem/|coupling/|apps/|tests/|" + heavy)));
}

TEST(Includes, OfIntegratorsAndPeriodicSolversKnowNoFrameAndNoMechanism)
{
  EXPECT_TRUE(none(includes_matching(tree(), {"coupling/integration/", "coupling/periodic/"}, {},
                                     "fem/|mechanism/|apps/|tests/|coupling/(?!integration/|periodic/)|" + heavy)));
}

TEST(Includes, OfCouplingLeaveTheHeavyLibrariesToTheReduction)
{
  EXPECT_TRUE(none(includes_matching(tree(), {"coupling/"},
                                     {"coupling/reduction/", "coupling/factors/", "coupling/eigensolvers/slepc/",
                                      "coupling/plugin/frame/", "coupling/plugin/team/"},
                                     heavy)));
  EXPECT_TRUE(none(includes_matching(tree(), {"coupling/"}, {}, "apps/|tests/")));
}

TEST(Includes, OfPrivateHeadersOfPetscAndSlepcAreInOneFile)
{
  const std::string internals = "(petsc|slepc)/private/", door = "coupling/eigensolvers/slepc/registered_types.cc";
  EXPECT_TRUE(none(includes_matching(tree(), everywhere, {door}, internals)));
  EXPECT_FALSE(includes_matching(tree(), {door}, {}, internals).empty());
}

TEST(Includes, GoByThePathFromTheTop)
{
  EXPECT_TRUE(none(includes_matching(tree(), everywhere, {}, "\\.\\./")))
      << "a path with .. hides which folder is included";
}

TEST(House, HasTheseEntriesAtItsTopAndNoOthers)
{
  const std::set<std::string> agreed = {
      "CMakeLists.txt", "CMakePresets.json", "fem",     "mechanism",    "coupling",    "meshes", "apps", "tests",
      "docs",           "README.md",         "LICENSE", "CHANGELOG.md", "CITATION.cff"};

  EXPECT_EQ(top_level_entries(GESTELL_SOURCE_DIR), agreed);
}

TEST(House, HasOneVersion)
{
  const std::string version = first_match("CMakeLists.txt", "project\\(gestell VERSION ([0-9.]+)");

  ASSERT_FALSE(version.empty());
  EXPECT_EQ(first_match("CHANGELOG.md", "^## \\[([0-9.]+)\\]"), version);
  EXPECT_EQ(first_match("CITATION.cff", "^version: \"?([0-9.]+)"), version);
}

TEST(House, HasOneLicence)
{
  EXPECT_EQ(first_match("LICENSE", "^(MIT License)$"), "MIT License");
  EXPECT_EQ(first_match("LICENSE", "^Copyright \\(c\\) [0-9]+ (.*)$"), "the Gestell developers");
  EXPECT_EQ(first_match("CITATION.cff", "^license: (.*)$"), "MIT");
}

TEST(Readme, QuotesTheSceneOfThePressAsItStands)
{
  const std::vector<std::string> scene  = lines_of("apps/scenes/press.toml");
  auto                           place  = scene.begin();
  int                            quoted = 0;
  bool                           inside = false;
  for (const std::string &line : lines_of("README.md"))
    if (line == "```toml" || line == "```")
      inside = line == "```toml";
    else if (inside && !line.empty())
    {
      const auto found = std::find(place, scene.end(), line);
      EXPECT_NE(found, scene.end()) << "not in the scene, or not in this order: " << line;
      place = found == scene.end() ? place : found + 1;
      ++quoted;
    }
  EXPECT_GT(quoted, 10);
}

TEST(Text, NamesNoPathOfAMachine)
{
  const std::regex path("(^|[^[:alnum:]._-])/(work|farm|root|tmp|home/[a-z]+|Users/[a-z]+)/");

  EXPECT_TRUE(std::regex_search(std::string("read \"/") + "work/main\"", path)) << "the pattern finds what it is for";
  EXPECT_TRUE(none(lines_matching(tree(), everywhere, {}, path)));
}

TEST(Text, NamesNoAddressOfAPackageHost)
{
  const std::regex host("(deb|security|ftp)\\.debian\\.org|archive\\.ubuntu\\.com|pypi\\.org|pythonhosted\\.org|"
                        "registry\\.npmjs|crates\\.io|conda\\.anaconda|proxy\\.golang|githubuserconten[t]");

  EXPECT_TRUE(std::regex_search(std::string("http://deb.") + "debian.org/debian", host));
  EXPECT_TRUE(none(lines_matching(tree(), everywhere, {}, host)));
}

TEST(Text, KeepsSourceFilesShortEnoughToRead)
{
  const std::regex source("\\.(h|cc)$");
  for (const auto &file : tree())
    if (std::regex_search(file.path, source))
    {
      EXPECT_LE(file.lines.size(), 450u) << file.path;
    }
}
