// Files of reference cases: how they are judged, what is refused, and that no table of reference values is forgotten.

#include "apps/verify/read_cases.h"
#include "tests/support/program.h"
#include "tests/support/refusal.h"

#include <set>

namespace gestell::tests
{
namespace
{

namespace fs = std::filesystem;

const std::string oscillator =
    "[parameters]\nc = '400 N/m'\nx0 = 0.01\n[body.mass]\ntype = 'slider'\naxis = [1, 0, 0]\nmass = '1 kg'\n"
    "[element.spring]\ntype = 'spring-damper'\nfrom = 'mass'\nstiffness = 'c'\n"
    "[start]\nq = { mass = 'x0' }\n[run]\nmethod = 'newmark'\nstep = '1 ms'\nend = '0.2 s'\n"
    "[output]\nstep = '5 ms'\n[output.signals]\nx = 'mass.displacement'\nv = 'mass.velocity'\n";

/// A file of one case with these checks beside a scene, and a table of x = x0 cos 20 t at 0, 0.1 and 0.2 s.
struct Cases
{
  explicit Cases(const std::string &checks, const std::string &more = "")
  {
    folder.file("scene.toml", oscillator);
    folder.file("exact.csv",
                "case,time,x\nfree,0,0.01\nfree,0.1,-0.004161468365\nfree,0.2,-0.006536436209\nother,0,7\n");
    path = folder.file("cases.toml",
                       "[case.free]\nstates = 'x = x0 cos 20 t'\nscene = 'scene.toml'\nsource = 'closed form'\n"
                       "because = 'order two'\n" +
                           more + "check = [" + checks + "]\n");
  }

  Answer verified() const { return gestell("verify " + path + " -o '" + folder.results().string() + "'"); }

  Folder      folder{"verify"};
  std::string path;
};

const std::string rows =
    "table = 'history.csv', columns = { 'x [m]' = 'x' }, at = { 't [s]' = 'time' }, expected = { file = "
    "'exact.csv', rows = { case = 'free' } }";

TEST(Verify, ValuesFormulasAndRowsThatAgreePass)
{
  const Cases cases("{ value = 'signals.v.min', expected = '-x0*sqrt(c/(1 kg))', relative = 1e-2 }, { " + rows +
                    ", relative = 1e-3 }");
  expect_answer(cases.verified(), 0, {"1 case, 2 checks: all passed", "manual: "});
  EXPECT_TRUE(fs::exists(cases.folder.results() / "verification.html"));
  EXPECT_NE(read(cases.folder.results() / "verification.md").find("3 numbers"), std::string::npos);
  EXPECT_EQ(count(read(cases.folder.results() / "verification.csv"), "\n"), 3);
}

TEST(Verify, AWrongExpectationFailsWithBothNumbersAndTheExitCodeOfAFailure)
{
  const Cases cases("{ value = 'signals.x.max', expected = 'x0*1.001', relative = 1e-4 }, { " + rows +
                    ", relative = 1e-3 }");
  expect_answer(cases.verified(), 3, {"FAILED  free", "expected 0.01001, obtained 0.01", "2 checks: 1 failed"});
  EXPECT_NE(read(cases.folder.results() / "verification.csv").find(",no,closed form"), std::string::npos);
}

TEST(Verify, EveryRowCounts)
{
  const Cases cases("{ " + rows + ", relative = 1e-3 }");
  cases.folder.file("exact.csv", "case,time,x\nfree,0,0.01\nfree,0.1,-0.004161468365\nfree,0.2,-0.0066\n");
  expect_answer(cases.verified(), 3, {"expected -0.0066, obtained -0.0065"});
  cases.folder.file("exact.csv", "case,time,x\nfree,0,0.01\nfree,0.151,0\n");
  expect_answer(cases.verified(), 3, {"history.csv has no row with t [s] = 0.151"});
}

TEST(Verify, AnInfinityIsMetByAnInfinityAlone)
{
  const Cases cases("{ " + rows + ", relative = 1e-3 }");
  cases.folder.file("exact.csv", "case,time,x\nfree,0,0.01\nfree,0.1,inf\n");
  expect_answer(cases.verified(), 3, {"expected ∞, obtained -0.0041"});
  cases.folder.file("exact.csv", "case,time,x\nfree,0,0.01\nfree,0.1,-0.0042\nfree,0.2,inf\n");
  expect_answer(cases.verified(), 3, {"expected ∞"});
}

TEST(Verify, AnExpectedCellWithoutAValueDoesNotCountAColumnOfThemFails)
{
  const Cases cases("{ " + rows + ", relative = 1e-3 }");
  cases.folder.file("exact.csv", "case,time,x\nfree,0,0.01\nfree,0.1,\n");
  expect_answer(cases.verified(), 0, {"all passed"});
  EXPECT_NE(read(cases.folder.results() / "verification.md").find("1 expected without a value"), std::string::npos);
  cases.folder.file("exact.csv", "case,time,x\nfree,0,\nfree,0.1,\n");
  expect_answer(cases.verified(), 3, {"column 'x'", "no value to compare"});
}

TEST(Verify, AnObtainedCellWithoutAValueFails)
{
  const Cases cases("{ table = 'solutions.csv', columns = { 'period ratio' = 'ratio', parameter = 'p' }, expected = { "
                    "file = 'exact.csv' } }",
                    "compute = 'periodic'\nwith = { period = '0.5 s' }\n");
  cases.folder.file("scene.toml", oscillator + "[element.damper]\ntype = 'spring-damper'\nfrom = 'mass'\n"
                                               "stiffness = 0\ndamping = '4 N s/m'\n"
                                               "[element.load]\ntype = 'force'\nfrom = 'mass'\n"
                                               "harmonics = [{ amplitude = '1 N', frequency = '2 Hz' }]\n");
  cases.folder.file("exact.csv", "ratio,p\n1,3\n");
  expect_answer(cases.verified(), 3, {"parameter, row 1: obtained nothing, expected '3'"}); // told with `along` alone
}

TEST(Verify, AnExpectedColumnMayBeAFormulaOfColumns)
{
  const std::string formula = "table = 'history.csv', columns = { 'x [m]' = 'x0*c' }, at = { 't [s]' = 'time' }, "
                              "expected = { file = 'exact.csv' }, relative = 1e-3";
  const Cases       cases("{ " + formula + " }");
  cases.folder.file("exact.csv", "time,x0,c\n0,0.01,1\n0.1,0.01,-0.4161468365\n");
  expect_answer(cases.verified(), 0, {"all passed"});
  cases.folder.file("exact.csv", "time,x0,c\n0,0.01,1\n0.1,0.01,-0.5\n");
  expect_answer(cases.verified(), 3, {"expected -0.005"});
}

/// Central differences, and a table of the end from which they grow.
struct MapCase
{
  explicit MapCase(const std::string &table, const std::string &more = "")
  {
    folder.file("ends.csv", "method,zeta,from,to\n" + table);
    path = folder.file("cases.toml", "[case.ends]\nstates = 'omega h = 2'\ncompute = 'integrators'\nsource = 'closed "
                                     "form'\nbecause = 'rounding'\ncheck = [{ table = 'unstable intervals', columns = "
                                     "{ from = 'from', to = 'to' }, relative_to = 'each', expected = { file = "
                                     "'ends.csv' }, relative = 1e-9 }]\n" +
                                         more + "[case.ends.methods]\ncentral = { method = 'central-difference' }\n");
  }
  Answer verified() const { return gestell("verify " + path + " -o '" + folder.results().string() + "'"); }

  Folder      folder{"verify_map"};
  std::string path;
};

TEST(Verify, AnIntervalWithoutAnEndIsNotALongOne)
{
  expect_answer(MapCase("central,0,2,inf\n").verified(), 0, {"all passed"});
  expect_answer(MapCase("central,0,2,1e300\n").verified(), 3, {"obtained ∞"});
  expect_answer(MapCase("central,0,2.1,inf\n").verified(), 3, {"expected 2.1"});
}

TEST(Verify, EveryMethodOfATableIsComputedOrLeftOutWithAReason)
{
  const std::string both = "central,0,2,inf\nlagged,0,2,inf\n";
  expect_answer(MapCase(both).verified(), 2, {"cases.toml:", "'lagged'", "methods_left_out"});
  const MapCase named(both, "[case.ends.methods_left_out]\nlagged = 'Gestell has none'\n");
  expect_answer(named.verified(), 0, {"all passed"});
  EXPECT_NE(read(named.folder.results() / "verification.md").find("lagged, Gestell has none"), std::string::npos);
  expect_answer(MapCase("central,0,2,inf\n", "[case.ends.methods_left_out]\nlaged = 'none'\n").verified(), 2,
                {"cases.toml:", "'laged'", "does not hold"});
}

TEST(Verify, WordsOfTheExpectedTableAreTranslated)
{
  const auto verified = [](const std::string &words)
  {
    const Cases cases("{ table = 'modes.csv', columns = { 'frequency [Hz]' = 'f', kind = 'sort' }, " + words +
                          "expected = { file = 'exact.csv' }, relative = 1e-3 }",
                      "compute = 'modes'\n");
    cases.folder.file("exact.csv", "f,sort\n3.1831,with all\n");
    return cases.verified();
  };
  expect_answer(verified(""), 3, {"obtained 'coupled', expected 'with all'"});
  expect_answer(verified("words = { kind = { 'with all' = 'coupled' } }, "), 0, {"all passed"});
  expect_answer(verified("words = { kinds = { 'with all' = 'coupled' } }, "), 2, {"cases.toml:", "words", "'kinds'"});
}

TEST(Verify, ABoundIsBrokenOnItsOwnSideAlone)
{
  const auto code = [](const char *bound, const char *expected)
  {
    return Cases(std::string("{ value = 'signals.x.max', expected = ") + expected + ", bound = '" + bound +
                 "', relative = 1e-12 }")
        .verified()
        .exit_code;
  };
  EXPECT_EQ(code("least", "0.009"), 0);
  EXPECT_EQ(code("least", "0.011"), 3);
  EXPECT_EQ(code("most", "0.011"), 0);
  EXPECT_EQ(code("most", "0.009"), 3);
}

TEST(Verify, TheOrderIsThatOfTheErrors)
{
  const std::string refined = "refine = { key = 'run.step', values = ['2 ms', '1 ms'] }\n";
  EXPECT_EQ(Cases("{ " + rows + ", order = 2, absolute = 0.1 }", refined).verified().exit_code, 0);
  expect_answer(Cases("{ " + rows + ", order = 3, absolute = 0.1 }", refined).verified(), 3,
                {"expected 3, obtained 1.999"});
}

TEST(Verify, AComputationThatFailsIsAFailedCheck)
{
  Cases cases("{ value = 'signals.x.max', expected = 0.01, relative = 1e-3 }");
  cases.folder.file("scene.toml",
                    oscillator +
                        "[element.blow]\ntype = 'formula force'\nfrom = 'mass'\nforce = '1 N/(0.1 - t/(1 s))'\n");
  EXPECT_EQ(cases.verified().exit_code, 3);
}

TEST(Verify, CasesThatSayWhatThereIsNotAreRefusedWithTheirPlace)
{
  const auto refused =
      [](const std::string &checks, const std::vector<std::string> &words, const std::string &more = "")
  {
    std::vector<std::string> all = words;
    all.push_back("cases.toml:");
    expect_answer(Cases(checks, more).verified(), 2, all);
  };
  const std::string expected = "expected = 1, relative = 1e-3 ";
  refused("{ " + expected + "}", {"needs either 'value'", "or 'table'"});
  refused("{ value = 'signals.y.max', " + expected + "}", {"y"});
  refused("{ value = 'signals.x.max', relative = 1e-3 }", {"expected", "is missing"});
  refused("{ value = 'signals.x.max', expected = 1, relativ = 1e-3 }", {"relativ", "relative"});
  refused("{ value = 'signals.x.max', expected = 'x0*', relative = 1e-3 }", {"x0*"});
  refused("{ value = 'signals.x.max', expected = { file = 'none.csv', column = 'x' }, relative = 1e-3 }", {"none.csv"});
  refused("{ value = 'signals.x.max', expected = { file = 'exact.csv', rows = { case = 'free' }, column = 'x' } }",
          {"3 rows"});
  refused("{ table = 'history.cvs', columns = { 'x [m]' = 'x' }, expected = { file = 'exact.csv' } }", {"history.csv"});
  refused("{ table = 'history.csv', columns = { 'x [mm]' = 'x' }, at = { 't [s]' = 'time' }, expected = { file = "
          "'exact.csv' } }",
          {"no column 'x [mm]'"});
  refused("{ table = 'history.csv', expected = { file = 'exact.csv' } }", {"columns", "is missing"});
  refused("{ value = 'signals.x.max', " + expected + ", order = 2 }", {"order", "refine"});
  refused("{ value = 'signals.x.max', " + expected + "}", {"compute", "runs"}, "compute = 'runs'\n");
  refused("{ value = 'signals.x.max', expected = '2 kg', relative = 1e-3 }", {"in kg", "in m"});
  refused("{ value = 'modes.1', " + expected + "}", {"'with'", "alongg"},
          "compute = 'modes'\nwith = { alongg = 'mass' }\n");
}

TEST(Verify, NamesThatAreNotACaseAreRefusedWithTheNearest)
{
  expect_answer(gestell("verify 'conical pendulums'"), 2, {"conical pendulum", "--list"});
  expect_answer(gestell("verify no_such.toml"), 2, {"no_such.toml"});
  expect_answer(gestell("verify --renew no_such_folder"), 2, {"--renew", "no_such_folder"});
}

TEST(Verify, EveryTableOfReferenceValuesIsReadByACaseOrNamedAsNotCovered)
{
  const fs::path        top = fs::path(GESTELL_SOURCE_DIR) / "tests/reference";
  std::set<std::string> read, named;
  for (const std::string &file : apps::case_files(GESTELL_SOURCE_DIR "/apps/verification"))
  {
    const apps::CaseFile cases = apps::read_cases(file);
    for (const auto &one : cases.cases)
      for (const auto &check : one.checks)
        if (!check.expected.table.file.empty())
          read.insert(fs::relative(check.expected.table.file, top).string());
    for (const auto &[name, why] : cases.left_out)
    {
      EXPECT_TRUE(fs::exists(top / name)) << name;
      EXPECT_FALSE(why.empty()) << name;
      named.insert(name);
    }
  }
  for (const auto &entry : fs::recursive_directory_iterator(top))
    if (entry.is_regular_file())
    {
      const std::string name = fs::relative(entry.path(), top).string();
      EXPECT_EQ(read.count(name) + named.count(name), 1u) << name << ": in no case and not named, or both";
    }
}

TEST(Verify, TheDocumentHoldsEveryCaseThatIsShipped)
{
  const std::string document = tests::read(GESTELL_SOURCE_DIR "/docs/trust/verification.md");
  for (const std::string &file : apps::case_files(GESTELL_SOURCE_DIR "/apps/verification"))
    for (const auto &one : apps::read_cases(file).cases)
      EXPECT_NE(document.find("**" + one.name + "**"), std::string::npos)
          << one.name << ": gestell verify --all --renew docs writes it";
}

} // namespace
} // namespace gestell::tests
