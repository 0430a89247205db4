// Heads of files announce how much follows; who believes them takes all memory for a few bytes.

#include "coupling/frame/hdf5_file.h"
#include "coupling/frame/matrix_market.h"
#include "coupling/frame/petsc_binary.h"
#include "coupling/integration/system/announced_size.h"
#include "coupling/integration/system/state_archive.h"
#include "tests/support/limited_memory.h"
#include "tests/support/program.h"
#include "tests/support/test.h"

namespace gestell::coupling
{
namespace
{

namespace fs = std::filesystem;
using tests::LimitedMemory;

constexpr std::size_t spare = std::size_t(8) << 20; // beyond a file of some kB: a few pages of allocators and buffers

constexpr std::uint64_t claims[] = {(1u << 31) - 1, std::uint64_t(1) << 40, std::uint64_t(1) << 61,
                                    std::uint64_t(1) << 63, std::numeric_limits<std::uint64_t>::max()};

enum class Order
{
  little,
  big
};

/// Calls read(bytes) with each field of 4 and of 8 bytes replaced by each claim.  It may read what the claim makes of
/// the file or refuse it in words; std::bad_alloc and std::length_error are no answers.
template <typename Read>
void claim_everywhere(const std::string &valid, Order order, std::size_t step, const Read &read)
{
  int refused = 0;
  for (std::size_t size : {4, 8})
    for (std::size_t at = 0; at + size <= valid.size(); at += step)
      for (const std::uint64_t claim : claims)
      {
        std::string forged = valid;
        for (std::size_t i = 0; i < size; ++i)
          forged[order == Order::little ? at + i : at + size - 1 - i] = char((claim >> (8 * i)) & 0xff);
        try
        {
          const LimitedMemory limited(spare);
          read(forged);
        }
        catch (const std::bad_alloc &)
        {
          ADD_FAILURE() << "memory is taken for " << claim << " at byte " << at << " in " << size << " bytes";
          return;
        }
        catch (const std::length_error &error)
        {
          ADD_FAILURE() << error.what() << " for " << claim << " at byte " << at << " in " << size << " bytes";
          return;
        }
        catch (const std::exception &message)
        {
          EXPECT_GT(std::strlen(message.what()), 10u);
          ++refused;
        }
      }
  EXPECT_GT(refused, 0);
}

class AnnouncedSizes : public ::testing::Test
{
protected:
  void write(const std::string &bytes) const { std::ofstream(file, std::ios::binary) << bytes; }

  const tests::Folder folder{"sizes"};
  const std::string   file = (folder / "bytes").string();
};

const Eigen::MatrixXd small = (Eigen::MatrixXd(2, 3) << 1., 0., -2., 0., 0., 0.5).finished();

} // namespace

TEST_F(AnnouncedSizes, ProductsDoNotOverflow)
{
  EXPECT_TRUE(stand_in(80, 10, 8));
  EXPECT_FALSE(stand_in(79, 10, 8));
  EXPECT_FALSE(stand_in(80, std::uint64_t(1) << 61, 8)); // whose product is 0
  EXPECT_FALSE(stand_in(80, std::uint64_t(1) << 32, std::uint64_t(1) << 32, 8));
  EXPECT_TRUE(stand_in(80, 5, 2, 8));
  EXPECT_FALSE(stand_in(80, 5, 3, 8));
  EXPECT_TRUE(stand_in(0, 7, 0, 8));
}

TEST_F(AnnouncedSizes, OfPetscAreJudgedByTheFile)
{
  write_petsc_matrix(file, small);
  const std::string dense = tests::read(file);
  write_petsc_matrix(file, Eigen::SparseMatrix<double>(small.sparseView()));
  for (const std::string &valid : {dense, tests::read(file)})
    claim_everywhere(valid, Order::big, 4,
                     [&](const std::string &forged)
                     {
                       write(forged);
                       read_petsc_matrix(file);
                     });
}

TEST_F(AnnouncedSizes, SixteenBytesOfPetscAreNotAMatrixOfAllMemory)
{
  for (const bool dense : {false, true})
  {
    std::string head("\x00\x12\x7b\x50\x00\x00\x00\x00\x7f\xff\xff\xf0\x00\x00\x00\x00", 16); // 0 x 2^31, empty
    if (dense)
      head.replace(12, 4, "\xff\xff\xff\xff");
    write(head);
    const LimitedMemory limited(spare);
    EXPECT_THROW(read_petsc_matrix(file), std::invalid_argument);
  }
}

TEST_F(AnnouncedSizes, OfMatrixMarketAreJudgedByTheFile)
{
  for (const std::string sizes : {"20000000 20000000 0", "20000000 0 0", "1 20000000 1\n1 1 1.0"})
  {
    write("%%MatrixMarket matrix coordinate real general\n" + sizes + "\n");
    const LimitedMemory limited(spare);
    EXPECT_THROW(read_matrix_market(file), std::invalid_argument) << sizes;
  }
}

TEST_F(AnnouncedSizes, AFewDampersOfALargeFrameAreAMatrixOfItsSize)
{
  const int n = 1000000;
  write("%%MatrixMarket matrix coordinate real general\n1000000 1000000 1\n1 1 5.0\n");
  EXPECT_THROW(read_matrix_market(file), std::invalid_argument);
  EXPECT_EQ(read_matrix_market(file, n).rows(), n);
}

/// HDF5 itself breaks off on some addresses that lead nowhere (of sealed files a checksum guards them): the sizes of
/// the arrays are replaced, and those of their bytes.
TEST_F(AnnouncedSizes, OfArraysAreJudgedByTheFile)
{
  Hdf5File written;
  written.write("A", small);
  written.write("text", std::string("words"));
  const std::string valid   = written.image();
  int               refused = 0;
  for (std::size_t at = 0; at + 8 <= valid.size(); at += 8)
    for (const std::uint64_t claim : claims)
    {
      std::uint64_t value;
      std::memcpy(&value, valid.data() + at, 8);
      if (value != 2 && value != 3 && value != 5 && value != 48)
        continue;
      std::string forged = valid;
      std::memcpy(forged.data() + at, &claim, 8);
      write(forged);
      try
      {
        const LimitedMemory limited(spare);
        const Hdf5File      again(file);
        again.read_matrix("A");
        again.read_text("text");
      }
      catch (const std::runtime_error &)
      {
        ++refused;
      }
      catch (const std::exception &error)
      {
        ADD_FAILURE() << "memory is taken for " << claim << " at byte " << at << ": " << error.what();
      }
    }
  EXPECT_GT(refused, 5);
}

namespace
{

struct Inner
{
  std::string         name;
  std::vector<double> values;
  double              room[100]; // memory that no byte of the archive stands for
  void                exchange(StateArchive &archive) { archive(name, values); }
};

struct State
{
  Eigen::VectorXd     q = Eigen::VectorXd::Ones(3);
  Eigen::MatrixXd     A = small;
  std::vector<double> list{1., 2.};
  std::string         text = "text";
  std::vector<Inner>  inner{{"a", {1.}, {}}, {"b", {}, {}}};
  void                exchange(StateArchive &archive) { archive(q, A, list, text, inner); }
};

} // namespace

TEST_F(AnnouncedSizes, OfCheckpointsAreJudgedByWhatIsLeft)
{
  StateArchive archive;
  State        state;
  state.exchange(archive);
  claim_everywhere(archive.bytes(), Order::little, 1,
                   [&](const std::string &forged)
                   {
                     StateArchive reading(forged);
                     State        read;
                     read.exchange(reading);
                     if (!reading.at_end())
                       throw std::runtime_error("more than a state");
                   });
}

TEST_F(AnnouncedSizes, EntriesWithFewBytesTakeMemoryOnlyWhenTheyAreRead)
{
  StateArchive empty;
  std::size_t  n = 1 << 20; // as many as the archive has bytes behind it, but each has 16 at least
  empty(n);
  StateArchive        reading(empty.bytes() + std::string(n, '\x7f'));
  std::vector<Inner>  inner;
  const LimitedMemory limited(spare);
  EXPECT_THROW(reading(inner), std::runtime_error);
}

} // namespace gestell::coupling
