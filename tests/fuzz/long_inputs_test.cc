// A file that is long in one respect ends in a message, or is read, as short ones are: no recursion by its length, no
// time by powers of it.  Mutations of small seeds do not get here.

#include "tests/fuzz/target.h"
#include "tests/support/test.h"

#include <exception>

namespace gestell::fuzz
{
namespace
{

std::string repeated(const std::string &text, int n)
{
  std::string all;
  for (int i = 0; i < n; ++i)
    all += text;
  return all;
}

struct LongInput
{
  std::string name, target, bytes;
};

/// Each refers to the next, the last to none.
std::string chain_of_systems(int n)
{
  std::string cards;
  for (int i = 1; i <= n; ++i)
    cards +=
        "CORD2R," + std::to_string(i) + "," + std::to_string(i < n ? i + 1 : 0) + ",0.,0.,0.,0.,0.,1.\n,1.,0.,0.\n";
  return cards + "GRID,1,1,1.,2.,3.\n";
}

std::string ranges_of_points(int n)
{
  std::string cards;
  for (int i = 1; i <= n; ++i)
    cards += "SPOINT," + std::to_string(10 * i) + ",THRU," + std::to_string(10 * i + 5) + "\n";
  cards += "DMIG,K,0,6,1\n";
  for (int i = 1; i <= n; ++i)
    cards += "DMIG,K," + std::to_string(i) + ",1,," + std::to_string(i) + ",1,2.\n";
  return cards;
}

std::string chain_of_parameters(int n)
{
  std::string text = "[parameters]\np0 = 1\n";
  for (int i = 1; i <= n; ++i)
    text += "p" + std::to_string(i) + " = \"p" + std::to_string(i - 1) + " + 1\"\n";
  return text + "[body.a]\ntype = \"slider\"\naxis = [1, 0, 0]\nmass = \"(1 kg)*p" + std::to_string(n) + "\"\n";
}

const std::vector<LongInput> &long_inputs()
{
  static const std::vector<LongInput> all = {
      {"LineThatIsNoToml", "scene", "a = 1, " + std::string(300000, '1') + " x\n"},
      {"HeadThatIsNoToml", "scene", "[" + std::string(300000, '[') + "a b]\n"},
      {"KeyThatStandsTwice", "scene",
       "\"" + std::string(300000, 'a') + "\" = 1\n\"" + std::string(300000, 'a') + "\" = 1\n"},
      {"NamesThatDiffer", "scene",
       "[body." + std::string(100000, 'a') + "]\ntype = \"slider\"\nmass = 1\naxis = [1, 0, 0]\n[element.e]\n" +
           "type = \"spring-damper\"\nfrom = \"" + std::string(100001, 'a') + "\"\nto = \"ground\"\nstiffness = 1\n"},
      {"ChainOfParameters", "scene", chain_of_parameters(3000)},
      {"KeyOfAnOverride", "override", repeated("a.", 60000) + "a=1"},
      {"ValueOfAnOverride", "override", "run.step=[" + std::string(300000, '1')},
      {"Parentheses", "expression", std::string(999, '(')},
      {"Signs", "expression", std::string(998, '-') + "u"},
      {"Powers", "expression", "u" + repeated("^u", 499)},
      {"Conditions", "expression", repeated("if(u<l,", 140)},
      {"ChainOfSystems", "nodes", chain_of_systems(50000)},
      {"IncludesOfItself", "nodes", "*NODE\n*INCLUDE, INPUT=fed.bdf\n*INCLUDE, INPUT=fed.bdf\n"},
      {"RangesOfPoints", "dmig", ranges_of_points(20000)},
      {"DirectionsOfNodes", "substructure",
       "*USER ELEMENT\n** ELEMENT NODES\n** " + repeated("1, ", 30000) + "1\n" + repeated("1, ", 30000) + "1\n"},
      {"LineOfNumbers", "universal",
       "    -1\n    58\na\nb\nc\nd\ne\nf\n 2 5 1 0. 1. 0.\n 18\n 8\n 0\n 0\n" + repeated(" 1.0", 200000) +
           "\n    -1\n"},
      {"ConstantsOfAScript", "geo", "DefineConstant[ " + repeated("a = {1, Min 0, Max {1}}, ", 20000) + "b = 1 ];\n"},
      {"BracketsOfAScript", "geo", "a = " + std::string(200000, '(') + std::string(200000, ')') + ";\n"},
      {"ElementOfACollection", "collection", "<VTKFile><DataSet " + std::string(1000000, 'a') + "></VTKFile>"},
      {"NestedRecord", "study_record", std::string(200000, '[')},
      {"QuotesOfATable", "table", "a,b\n" + std::string(1000000, '"') + "\n"}};
  return all;
}

using Long = ::testing::TestWithParam<LongInput>;

TEST_P(Long, EndsInAMessageOrIsRead)
{
  std::string finding;
  try
  {
    feed(target(GetParam().target), GetParam().bytes);
  }
  catch (const std::exception &broken)
  {
    finding = broken.what();
  }
  EXPECT_EQ(finding.substr(0, 300), "");
}

INSTANTIATE_TEST_SUITE_P(Input, Long, ::testing::ValuesIn(long_inputs()),
                         [](const auto &info) { return info.param.name; });

} // namespace
} // namespace gestell::fuzz
