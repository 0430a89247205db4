// Files that are cut off, contradict themselves or hold what no frame is: refused with the line and the way out.

#include "coupling/exchange/matrices_of_file.h"
#include "coupling/exchange/node_places.h"
#include "coupling/exchange/row_table.h"
#include "tests/support/lumped_frame.h"
#include "tests/support/refusal.h"
#include "tests/support/test.h"
#include "tests/support/text_folder.h"

#include <random>

namespace
{

using namespace gestell;

struct Refused : ::testing::Test
{
  tests::TextFolder folder;

  /// What is said against a text, and that all of the words are in it.
  void expect(const std::string &text, const std::vector<std::string> &words) const
  {
    const std::string said = tests::refusal([&] { coupling::matrices_of_file(folder.write("a.txt", text)); });
    for (const std::string &word : words)
      EXPECT_NE(said.find(word), std::string::npos) << "no '" << word << "' in: " << said << "\n"
                                                    << text.substr(0, 200);
  }
  void expect_rows(const std::string &text, const std::vector<std::string> &words) const
  {
    const std::string said = tests::refusal([&] { coupling::read_row_table(folder.write("a.dof", text)); });
    for (const std::string &word : words)
      EXPECT_NE(said.find(word), std::string::npos) << "no '" << word << "' in: " << said;
  }
  void expect_places(const std::string &text, const std::vector<std::string> &words) const
  {
    const std::string said = tests::refusal(
        [&] {
          coupling::read_model_nodes(folder.write("model.txt", text), {1, 2});
        });
    for (const std::string &word : words)
      EXPECT_NE(said.find(word), std::string::npos) << "no '" << word << "' in: " << said;
  }
};

const std::string head = "DMIG,K,0,6,2\n";

TEST_F(Refused, CardsOfNastran)
{
  expect("DMIG,K,0,6,3\n", {"a.txt:1", "complex", "real"});
  expect("DMIG,K,0,6,4\n", {"complex"});
  expect("DMIG,K,0,6,7\n", {"TIN", "1 and 2 are real"});
  expect("DMIG,K,0,5,2\n", {"IFO", "6 symmetric"});
  expect("DMIG,K,0,,2\n", {"IFO", "blank"});
  expect(head + head, {"a.txt:2", "header already"});
  expect("DMIG,K,1,1,,1,1,2.\n", {"precedes its header", "may be missing"});
  expect(head + "DMIG,K,1,1,,1,1,2.,0.5\n", {"imaginary"});
  expect(head + "DMIG,K,1,1,,1,1,\n", {"a.txt:2", "no value", "truncated"});
  expect(head + "DMIG,K,1,1,,1,1,2.\nDMIG,K,1,1,,1,1,2.\n",
         {"a.txt:3", "(node 1, ux)", "duplicate", "line 2", "not added"});
  expect(head + "DMIG,K,1,1,,2,1,2.\nDMIG,K,2,1,,1,1,2.\n", {"a.txt:3", "each pair once"});
  expect(head + "DMIG,K,1,7,,1,1,2.\n", {"component 7", "1 to 6"});
  expect(head + "DMIG,K,-1,1,,1,1,2.\n", {"start at 1"});
  expect(head + "DMIG,K,1,1,,1,1,nan\n", {"not a finite number"});
  expect(head + "DMIG,K,1,1,,1,1,inf\n", {"not a finite number"});
  expect(head + "DMIG,K,1,1,,1,1,1.+999\n", {"not a finite number"});
  expect(head + "DMIG,K,1,1,,1,1,2.0.1\n", {"is not a number"});
  expect(head + "DMIG,K,1,x,,1,1,2.\n", {"'x' is not an integer"});
  expect(head + "DMIG\tK\t1\n", {"tabs"});
  expect(head + "DMIG,K,1,1,,1,1,2.,,2,1,3.\n", {"a.txt:2", "8 fields", "one more"});
  expect("", {"MatrixMarket"});
}

TEST_F(Refused, BinaryFilesWithTheWayOut)
{
  expect(std::string("d\0\0\0 FULL file of a solver", 28),
         {"not text", "HBMAT", "*EXPORT", "DMIGPCH", "MATRIXSTORAGE"});
}

TEST_F(Refused, TrianglesOfCalculix)
{
  expect("1 1 2.\n1 2\n", {"a.txt:2", "row column value", "truncated"});
  expect("1 1 2.\n0 1 2.\n", {"a.txt:2", "start at 1"});
  expect("1 1 2.\n2000000000 2000000000 1.\n", {"a.txt:2", "a file of this length"});
  expect("1 1 2.\n1 1 2.\n", {"a.txt:2", "duplicate", "line 1"});
  expect("1 1 2.\n1 2 1.\n2 1 1.\n1 2 1.\n", {"a.txt:4", "duplicate"});
  expect("1 1 2.\n2 2 NaN\n", {"a.txt:2", "not a finite number"});
  expect("1 1 2.\n2 2 *****\n", {"a.txt:2", "is not a number"});
  expect("\n2 2 3\n1 1 2.\n1 2 1.\n2 2 2.\n", {"a.txt:2", "header line", "%%MatrixMarket"});
}

TEST_F(Refused, Substructures)
{
  const std::string element = "*USER ELEMENT,NODES=2,LINEAR\n** ELEMENT NODES\n** 1, 2\n1\n*MATRIX,TYPE=STIFFNESS\n";
  expect(element + "1.,\n0., 1., 1.,\n", {"a.txt:7", "more numbers"});
  expect(element + "1.,\n0.,\n", {"a.txt:5", "3 numbers, but 2 follow", "truncated"});
  expect(element + "1.,\n0., 1.\n*MATRIX,TYPE=STIFFNESS\n1.\n0.,1.\n", {"given twice"});
  expect("*MATRIX,TYPE=STIFFNESS\n1.\n", {"precedes its *USER ELEMENT"});
  expect("*USER ELEMENT,NODES=2,LINEAR\n1,2,3\n*MATRIX,TYPE=STIFFNESS\n1.\n", {"ELEMENT NODES"});
  expect("*USER ELEMENT,NODES=1\n** ELEMENT NODES\n** 1\n8\n*MATRIX,TYPE=MASS\n1.\n", {"direction 8"});
  expect("*USER ELEMENT,NODES=1\n** ELEMENT NODES\n** 1\n1,1\n*MATRIX,TYPE=MASS\n1.\n", {"twice"});
  expect("*USER ELEMENT,NODES=1\n** ELEMENT NODES\n** -1\n1\n*MATRIX,TYPE=MASS\n1.\n", {"a.txt:3", "start at 1"});
  expect("*USER ELEMENT,NODES=1\n** ELEMENT NODES\n** 1\n1\n5,1\n*MATRIX,TYPE=MASS\n1.\n", {"nodes 1 to 1"});
}

TEST_F(Refused, HarwellBoeing)
{
  const std::string formats = "(3I2)           (3I2)           (3E8.1)             \n";
  const auto        with    = [&](const std::string &type, const std::string &numbers)
  { return "t\n1 1 1 1 0\n" + type + "\n" + formats + numbers; };
  expect(with("CSA 2 2 2 0", ""), {"complex", "STIFF, MASS"});
  expect(with("PSA 2 2 2 0", ""), {"pattern"});
  expect(with("RSE 2 2 2 0", ""), {"element matrices"});
  expect(with("RZA 2 2 2 0", ""), {"RSA and RUA"});
  expect(with("RUA 2 3 2 0", ""), {"2 x 3"});
  expect(with("RSA 2000000000 2000000000 2000000000 0", ""), {"a.txt:3", "not fit in a file of"});
  expect(with("RSA 2 2 2000000000 0", ""), {"not fit in a file of"});
  expect(with("RSA 2 2 2 0", " 1 2 3\n 1 2\n 1.0E+00"), {"1 values are still announced", "truncated"});
  expect(with("RSA 2 2 2 0", " 1 2 4\n"), {"must increase from 1 to 3"});
  expect(with("RSA 2 2 2 0", " 1 2 3\n 1 3\n"), {"there is no row 3"});
  expect(with("RSA 2 2 3 0", " 1 3 4\n 1 1 2\n 1.0E+00 1.0E+00 1.0E+00\n"), {"duplicate"});
  expect(with("RSA 2 2 2 0", " 1 2 3\n 1 2\n 1.0E+00     nan\n"), {"not a finite number"});
  expect("t\n1 1 1 1 0\nRSA 2 2 2 0\nnone\n", {"formats"});
}

TEST_F(Refused, TablesOfRows)
{
  expect_rows("1.1\n1.1\n", {"node 1, ux", "row 1 and row 2"});
  expect_rows("1.7\n", {"direction 7"});
  expect_rows("1\n", {"node.direction"});
  expect_rows("1 -5 UX\n", {"a.dof:1", "node -5", "start at 1"});
  expect_rows("1 0 UX\n", {"start at 1"});
  expect_rows("0.1\n", {"start at 1"});
  expect_rows("1 2 TEMP\n", {"'TEMP' is not a DOF", "ROTX"});
  expect_rows("1 2 UX\n3 2 UY\n", {"row 2 is missing"});
  expect_rows("1 2 UX\n1 2 UY\n", {"row 1 already exists"});
  expect_rows("1000000 2 UX\n", {"has fewer"});
  expect_rows("1 2 UX\n1.2\n", {"mixed"});
  expect_rows("", {"names no row"});
}

TEST_F(Refused, SystemsOfNodesOtherThanTheGlobalOne)
{
  expect_places("GRID,1,,0.,0.,0.,5\n", {"model.txt:1", "grid point 1", "CD", "no CORD2R"});
  expect_places("GRID,1,5,0.,0.,0.\n", {"CP"});
  expect_places("CORD2R,5,,0.,0.,0.,1.,0.,0.,\n,2.,0.,0.\nGRID,1,5,0.,0.,0.\n", {"model.txt:1", "on a line"});
  expect_places("CORD2R,5,5,0.,0.,0.,0.,0.,1.,\n,1.,0.,0.\nGRID,1,,0.,0.,0.\n", {"refers to itself"});
  expect_places("CORD2C,5,,0.,0.,0.,0.,0.,1.,\n,1.,0.,0.\nGRID,1,,0.,0.,0.,5\n", {"rectangular"});
  expect_places("GRDSET,,,,,,5\nGRID,1,,0.,0.,0.\n", {"CD"});
  expect_places("GRID,1,,0.,0.,0.\nGRID,1,,1.,0.,0.\n", {"model.txt:2", "another position"});
  expect_places("GRID,1,,0.,zero,0.\n", {"'zero' is not a number"});
  expect_places("*NODE,SYSTEM=C\n1,0.,0.,0.\n", {"rectangular"});
  expect_places("*NODE\n1,0.,0.,0.\n*TRANSFORM,NSET=A\n1.,0.,0.,0.,1.,0.\n", {"model.txt:3", "TRANSFORM"});
  expect_places("*NODE\n1,a,0.,0.\n", {"model.txt:2", "x, y, z"});
  for (const std::string node : {"1abc,0.,0.,0.", "1,0x10,0.,0.", "1,0.5junk,0.,0.", "1,nan,0.,0.", "1,1e400,0.,0."})
    expect_places("*NODE\n" + node + "\n", {"model.txt:2", "x, y, z"});
  expect_places("*SYSTEM\n100.,0.,0.\n*NODE\n1,0.,0.,0.\n", {"model.txt:2", "*SYSTEM moves", "global system"});
  expect_places("*INSTANCE,NAME=I,PART=P\n5.,0.,0.\n*NODE\n1,0.,0.,0.\n", {"model.txt:2", "*INSTANCE moves"});
  expect_places("NBLOCK,6,SOLID\n(3i9,6e21.13e3)\n        1        0        0 0.0000000000000E+000 "
                "0.0000000000000E+000 0.0000000000000E+000 3.0000000000000E+001\n",
                {"rotated", "NROTAT"});
  expect_places("NBLOCK,6\nnone\n", {"format of the nodes"});
  EXPECT_EQ(tests::refusal([&] { coupling::read_model_nodes(folder.write("m", "GRID,9,5,0.,0.,0.,7\n"), {1}); }), "")
      << "a node without rows may be in any system";
  EXPECT_EQ(tests::refusal(
                [&] {
                  coupling::read_model_nodes(folder.write("m", "*SYSTEM\n*NODE\n1,0.,0.,0.\n*INSTANCE\n0.,0.\n"), {1});
                }),
            "")
      << "nothing is moved";
}

/// A text with a few bytes changed, or cut off.
std::string damaged(std::string text, std::minstd_rand &dice)
{
  static const std::string bytes = "0123456789.,*+-eED $ \n\tGRIDNa";
  if (dice() % 3 == 0)
    text.resize(dice() % text.size());
  for (auto n = text.empty() ? 0 : dice() % 4; n > 0; --n)
    text[dice() % text.size()] = bytes[dice() % bytes.size()];
  return text;
}

TEST_F(Refused, DamagedFilesAreReadOrRefusedWithTheirName)
{
  const auto      &frame = tests::lumped_frame(true);
  std::minstd_rand dice(7);
  using tests::CardFields;
  const std::vector<std::string> texts = {
      tests::grid_text(frame) + tests::dmig_text("KAAX", frame.C, frame.rows, CardFields::large),
      "SPOINT,1,THRU,9\n" + tests::dmig_text("KAAX", frame.M, frame.rows, CardFields::small_),
      tests::dmig_text("KAAX", frame.M, frame.rows, CardFields::free_),
      tests::indexed_text(frame.M),
      tests::element_matrix_text({{"STIFFNESS", frame.M}}, frame.rows, true),
      tests::harwell_boeing_text(frame.M, true),
      tests::inp_text(frame),
      tests::nblock_text(frame),
      tests::dof_text(frame.rows),
      tests::mapping_text(frame.rows)};
  int refused = 0;
  for (const std::string &text : texts)
    for (int k = 0; k < 20; ++k)
    {
      const std::string file = folder.write("d.txt", damaged(text, dice));
      for (const auto &read : {std::function<void()>([&] { coupling::matrices_of_file(file); }),
                               std::function<void()>([&] { coupling::read_row_table(file); }),
                               std::function<void()>(
                                   [&] {
                                     coupling::read_model_nodes(file, {7, 11, 12, 23});
                                   })})
        if (const std::string said = tests::refusal(read); !said.empty())
        {
          ++refused;
          EXPECT_EQ(said.find(file), 0u) << said;
        }
    }
  EXPECT_GT(refused, 200);
}

TEST_F(Refused, FilesWithoutTheMatrixThatIsMeant)
{
  const auto all = coupling::matrices_of_file(
      folder.write("a.pch", "DMIG,KA,0,6,1\nDMIG,KA,1,1,,1,1,2.\nDMIG,KB,0,6,1\nDMIG,KB,1,1,,1,1,2.\n"));
  using coupling::MatrixRole;
  tests::expect_refusal([&] { coupling::matrix_for(all, MatrixRole::mass, "", "a.pch"); }, "matrix_names = { mass");
  tests::expect_refusal([&] { coupling::matrix_for(all, MatrixRole::stiffness, "", "a.pch"); }, "KA, KB");
  tests::expect_refusal([&] { coupling::matrix_for(all, MatrixRole::stiffness, "KC", "a.pch"); }, "has no matrix 'KC'");
  EXPECT_EQ(coupling::matrix_for(all, MatrixRole::stiffness, "kb", "a.pch").A.coeff(0, 0), 2.);
}

} // namespace
