// How large the house is: numbers that may only fall (bulk.txt).

#include "tests/architecture/source_tree.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

/// What is counted, over the lines of C++ of one half of the house.
struct Count
{
  std::vector<std::string> folders;
  std::regex               pattern;
};

const std::vector<std::string> program = {"apps/", "coupling/", "fem/", "mechanism/"};

const std::map<std::string, Count> &counts()
{
  static const std::map<std::string, Count> all = {
      {"lines of source", {program, std::regex("")}},
      {"lines of apps", {{"apps/"}, std::regex("")}},
      {"lines of tests", {{"tests/"}, std::regex("")}},
      {"types", {program, std::regex(R"(^\s*(class|struct|enum class|enum|union) \w+( final)?( *:.*[^;])?$)")}},
      {"numbers at namespace scope",
       {program,
        std::regex(
            R"(^(inline |static )?(constexpr|const) (double|int|long|float|(std::|Eigen::)?\w*(size_t|Index|int\d+_t|chrono\S*)) +\w+)")}},
      {"functions that write JSON, CSV, tables, sections or Python by hand",
       {program,
        std::regex(
            R"(^(static |inline )?(Json|\S*Section\S*|std::string|CsvTable|py::(dict|list|object)) \w*(_json|_csv|_html|_text|_table|_section|_dict)\()")}}};
  return all;
}

std::map<std::string, long> measured()
{
  std::map<std::string, long> found;
  for (const SourceFile &file : read_source_tree(GESTELL_SOURCE_DIR))
  {
    const std::string end = file.path.substr(file.path.find_last_of('.') + 1);
    if (end != "cc" && end != "h")
      continue;
    for (const auto &[name, count] : counts())
      for (const std::string &folder : count.folders)
        if (file.path.compare(0, folder.size(), folder) == 0)
          for (const std::string &line : file.lines)
            found[name] += std::regex_search(line, count.pattern);
  }
  return found;
}

} // namespace

// "name: now, limit" in each line.  What exceeds its number has grown; what is a hundredth below it needs a new number.
TEST(Bulk, OnlyFalls)
{
  const std::map<std::string, long> found = measured();
  std::ifstream                     file(GESTELL_SOURCE_DIR "/tests/architecture/bulk.txt");
  std::size_t                       rows = 0;
  for (std::string line; std::getline(file, line);)
  {
    const std::size_t  colon = line.find(':');
    std::istringstream numbers(line.substr(colon + 1));
    const std::string  name = line.substr(0, colon);
    long               now = 0, limit = 0;
    char               comma = ' ';
    std::string        word;
    ASSERT_TRUE(numbers >> now >> comma >> word >> limit && word == "limit" && found.count(name)) << line;
    EXPECT_LE(found.at(name), now) << name << ": delete elsewhere what is added here";
    EXPECT_GE(found.at(name), now - now / 100 - 1) << name << ": lower its number in tests/architecture/bulk.txt";
    ++rows;
  }
  EXPECT_EQ(rows, counts().size());
}

} // namespace gestell::tests
