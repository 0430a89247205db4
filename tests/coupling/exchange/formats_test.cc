// What other programs write comes in as the matrix they had, to the digits they wrote.

#include "coupling/exchange/dmig.h"
#include "coupling/exchange/matrices_of_file.h"
#include "coupling/exchange/node_places.h"
#include "coupling/exchange/row_table.h"
#include "tests/support/lumped_frame.h"
#include "tests/support/test.h"
#include "tests/support/text_folder.h"

#include <ctime>

namespace
{

using namespace gestell;
using coupling::LabelledMatrix;
using Eigen::MatrixXd;

const tests::LumpedFrame frame = tests::lumped_frame(true);

/// Largest difference as a share of the largest entry, rows brought into the order of `rows`.
double difference(const LabelledMatrix &read, const MatrixXd &A, const std::vector<tests::FileRow> &rows)
{
  std::vector<coupling::RowLabel> labels;
  for (const auto &[node, direction] : rows)
    labels.push_back({node, direction});
  const MatrixXd B = read.rows.empty() ? MatrixXd(read.A) : MatrixXd(spread(read, labels));
  return (B - A).cwiseAbs().maxCoeff() / A.cwiseAbs().maxCoeff();
}

struct Formats : ::testing::Test
{
  tests::TextFolder folder;

  std::map<std::string, LabelledMatrix> read(const std::string &text) const
  {
    return coupling::matrices_of_file(folder.write("a.txt", text));
  }
};

TEST_F(Formats, CardsOfNastranInEachKindOfFields)
{
  using tests::CardFields;
  const auto read_cards = [&](CardFields fields)
  {
    const auto all = read("$ a remark\n" + tests::dmig_text("KAAX", frame.C, frame.rows, fields) + "$ between\n" +
                          tests::dmig_text("maax", frame.M, frame.rows, fields));
    EXPECT_EQ(all.size(), 2u);
    return std::max(difference(all.at("KAAX"), frame.C, frame.rows), difference(all.at("MAAX"), frame.M, frame.rows));
  };
  EXPECT_LT(read_cards(CardFields::free_), 1e-16);
  EXPECT_LT(read_cards(CardFields::large), 5.1e-10) << "ten digits";
  EXPECT_LT(read_cards(CardFields::small_), 5.1e-4) << "the fewest digits that eight columns take are four";
}

TEST_F(Formats, ShortExponentsAndThoseOfFortran)
{
  const auto     all = read("DMIG    A              0       1       2\n"
                                "DMIG    A              1       1               1       1   1.5-3\n"
                                "dmig,a,2,3,,2,3,+1.5D+3\n"
                                "*,1,1,-2.5+0\n");
  const MatrixXd A   = all.at("A").A;
  EXPECT_EQ(A(0, 0), 1.5e-3);
  EXPECT_EQ(A(1, 1), 1.5e3);
  EXPECT_EQ(A(0, 1), -2.5);
}

TEST_F(Formats, CardsBetweenBeginBulkAndEnddataAlone)
{
  const auto all = read("SOL 103\nCEND\nTITLE = DMIG\nBEGIN BULK\nGRID,1,,0.,0.,0.\nDMIG,K,0,6,1\nDMIG,K,1,1,,1,1,2.\n"
                        "ENDDATA\nDMIG,K,1,1,,1,1,2.\n");
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all.at("K").A.coeff(0, 0), 2.);
}

TEST_F(Formats, PointsOfModesComeLastWhateverTheirComponentIsCalled)
{
  const auto all =
      read("SPOINT,3,THRU,5\nDMIG,K,0,6,1\nDMIG,K,4,1,,4,1,2.\nDMIG,K,10,1,,10,1,3.\nDMIG,K,9,0,,9,0,4.\n");
  const std::vector<coupling::RowLabel> rows = {{10, 1}, {4, 0}, {9, 0}};
  EXPECT_EQ(all.at("K").rows, rows);
}

TEST_F(Formats, RectangularMatricesAreLoadsAndStayOutside)
{
  EXPECT_EQ(read("DMIG,PAX,0,9,1,,,,2\nDMIG,PAX,1,0,,1,1,2.\nDMIG,K,0,6,1\nDMIG,K,1,1,,1,1,2.\n").size(), 1u);
}

TEST_F(Formats, WrittenCardsAreReadBack)
{
  std::vector<coupling::RowLabel> rows;
  for (const auto &[node, direction] : frame.rows)
    rows.push_back({node, direction});
  std::sort(rows.begin(), rows.end());
  const auto file = folder.write("b.pch", "");
  coupling::write_dmig(file, {{"KAAX", frame.C}}, rows, {{7, {0.1, -2e-150, 3.}}}, "a remark");
  const auto all = coupling::matrices_of_file(file);
  EXPECT_EQ(all.at("KAAX").rows, rows);
  EXPECT_LT((MatrixXd(all.at("KAAX").A) - frame.C).cwiseAbs().maxCoeff(), 5.1e-10 * frame.C.cwiseAbs().maxCoeff());
  EXPECT_EQ(coupling::read_model_nodes(file, {7}).places.at(7), (std::array<double, 3>{0.1, -2e-150, 3.}));
}

TEST_F(Formats, TrianglesOfCalculix)
{
  EXPECT_LT(difference(read(tests::indexed_text(frame.C)).at(""), frame.C, frame.rows), 1e-13);
  EXPECT_LT(difference(read(tests::indexed_text(frame.M)).at(""), frame.M, frame.rows), 1e-13);
}

TEST_F(Formats, SubstructuresOfCalculixAndAbaqus)
{
  for (const bool by_direction : {true, false})
  {
    const auto all =
        read(tests::element_matrix_text({{"STIFFNESS", frame.C}, {"MASS", frame.M}}, frame.rows, by_direction));
    EXPECT_LT(difference(all.at("STIFFNESS"), frame.C, frame.rows), 1e-13);
    EXPECT_LT(difference(all.at("MASS"), frame.M, frame.rows), 1e-13);
  }
}

TEST_F(Formats, HarwellBoeingOfAnsysSymmetricOrNot)
{
  for (const bool symmetric : {true, false})
    EXPECT_LT(difference(read(tests::harwell_boeing_text(frame.C, symmetric)).at(""), frame.C, frame.rows), 1e-15);
}

TEST_F(Formats, NumbersOfHarwellBoeingMayTouch)
{
  const auto all = read("t\n1 1 1 1 1\nRSA 2 2 3 0\n(3I2)           (3I2)           (1P,2E9.2)          \n(F)\n"
                        " 1 3 4\n 1 2 2\n-1.00E+00-2.00E+00\n-3.00E+00\n 9.00E+00 9.00E+00\n");
  EXPECT_EQ(MatrixXd(all.at("").A), (MatrixXd(2, 2) << -1., -2., -2., -3.).finished());
}

TEST_F(Formats, RowsAreNamedByNodeAndDirection)
{
  std::vector<coupling::RowLabel> rows;
  for (const auto &[node, direction] : frame.rows)
    rows.push_back({node, direction});
  EXPECT_EQ(coupling::read_row_table(folder.write("a.dof", tests::dof_text(frame.rows))), rows);
  EXPECT_EQ(coupling::read_row_table(folder.write("a.mapping", tests::mapping_text(frame.rows))), rows);
}

TEST_F(Formats, PlacesOfNodesFromEachModel)
{
  for (const std::string &text : {tests::grid_text(frame), tests::inp_text(frame), tests::nblock_text(frame)})
  {
    const auto places = coupling::read_model_nodes(folder.write("model", text), {11, 12, 23, 7, 99}).places;
    ASSERT_EQ(places.size(), 4u) << text;
    for (const auto &[number, x] : frame.nodes)
      EXPECT_EQ(places.at(number), x);
  }
}

TEST_F(Formats, CoordinatesOfInpMayBeThoseOfFortran)
{
  const auto places = coupling::read_model_nodes(folder.write("a.inp", "*NODE\n 3, 1.0D-01,, -2.5d+1\n"), {3}).places;
  EXPECT_EQ(places.at(3), (std::array<double, 3>{0.1, 0., -25.}));
}

TEST_F(Formats, RemarksStandAnywhereInASubstructure)
{
  std::string text  = tests::element_matrix_text({{"STIFFNESS", frame.C}, {"MASS", frame.M}}, frame.rows, true);
  const auto  known = read(text);
  for (auto at = text.find('\n', text.find("*MATRIX")); at != std::string::npos; at = text.find('\n', at + 13))
    text.insert(at + 1, "** a remark\n");
  const auto remarked = read(text);
  for (const std::string name : {"STIFFNESS", "MASS"})
    EXPECT_EQ(MatrixXd(remarked.at(name).A), MatrixXd(known.at(name).A)) << name;
}

/// Least processor time [s] of three readings of n x n / 2 entries.
double reading_time(const tests::TextFolder &folder, int n)
{
  std::ostringstream text;
  for (int j = 1; j <= n / 2; ++j)
    for (int i = 1; i <= n; ++i)
      text << i + (j - 1) * (j % 2) << ' ' << i + (j - 1) * (j % 2) + j - 1 << "  2.9166666666667e+06\n";
  const std::string file  = folder.write("large.sti", text.str());
  double            least = 1e9;
  for (int k = 0; k < 3; ++k)
  {
    const auto start = std::clock();
    EXPECT_GT(coupling::matrices_of_file(file).at("").A.nonZeros(), n * n / 2);
    least = std::min(least, double(std::clock() - start) / CLOCKS_PER_SEC);
  }
  return least;
}

TEST_F(Formats, FourTimesTheEntriesTakeAboutFourTimesTheWork)
{
  EXPECT_LT(reading_time(folder, 600), 8. * reading_time(folder, 300)) << "16 times if each were looked for among all";
}

} // namespace
