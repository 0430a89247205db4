#include "coupling/frame/reduced_frame_file.h"

#include "coupling/frame/sha256.h"
#include "tests/support/frame_folder.h"
#include "tests/support/refusal.h"
#include "tests/support/test.h"

#include <cstdint>
#include <tuple>

namespace gestell
{
namespace
{

namespace fs = std::filesystem;
using coupling::ReducedFrame;
using test::bytes;
using test::FrameFolder;
using test::some_frame;

class ReducedFrameFile : public FrameFolder
{
protected:
  std::string file = (folder / "below" / "frame.h5").string();
};

TEST_F(ReducedFrameFile, ComesBackBitByBit)
{
  const ReducedFrame frame = some_frame();
  coupling::write_reduced_frame(file, frame);
  const ReducedFrame back = coupling::read_reduced_frame(file);

  ASSERT_EQ(back.interfaces.size(), 1u);
  ASSERT_EQ(back.outputs.size(), 1u);
  const auto top = [](const ReducedFrame &f)
  {
    return std::tie(f.M, f.B, f.C, f.n_interface, f.omega0, f.translations_load, f.points, f.triangles, f.displacement,
                    f.n_full, f.n_cells, f.mass, f.frequencies_hz, f.frequency_error, f.static_residual, f.notes,
                    f.statements);
  };
  const auto inner = [](const ReducedFrame &f)
  {
    const auto &interface = f.interfaces[0];
    const auto &output    = f.outputs[0];
    const auto &s         = f.stress;
    return std::tie(interface.name, interface.position, interface.coordinate, interface.sign, output.name, output.unit,
                    output.on_q, output.on_v, output.under_acceleration, s.point, s.triangles, s.rigid, s.nearby,
                    s.mean, s.deviation);
  };
  EXPECT_TRUE(top(back) == top(frame));
  EXPECT_TRUE(inner(back) == inner(frame));
}

TEST_F(ReducedFrameFile, IsTheSameFileWhenWrittenAgain)
{
  const coupling::FrameOrigin origin{{{"mesh.size", "0.08"}, {"a=b\n", "1 2 c"}}, "press.toml", "press.step"};
  coupling::write_reduced_frame(file, some_frame(), origin);
  const auto stored = coupling::read_stored_frame(file);
  EXPECT_EQ(coupling::text_of(stored.origin.recipe), coupling::text_of(origin.recipe));
  EXPECT_EQ(stored.origin.scene, "press.toml");
  coupling::write_reduced_frame(file + ".again", stored.frame, stored.origin);
  EXPECT_EQ(bytes(file + ".again"), bytes(file));                            // every part came back
  EXPECT_EQ(std::distance(fs::directory_iterator(folder / "below"), {}), 2); // nothing is left beside them
}

TEST_F(ReducedFrameFile, EveryChangedByteIsNoticed)
{
  coupling::write_reduced_frame(file, some_frame());
  const std::string whole = bytes(file);
  for (std::size_t at = 0; at < whole.size(); at += 97) // 97 is prime to every size of a block
  {
    std::string changed = whole;
    changed[at] ^= 1;
    std::ofstream(file, std::ios::binary) << changed;
    EXPECT_THROW(coupling::read_reduced_frame(file), std::invalid_argument) << "byte " << at;
  }
  std::ofstream(file, std::ios::binary) << whole << " ";
  EXPECT_THROW(coupling::read_reduced_frame(file), std::invalid_argument);
}

TEST_F(ReducedFrameFile, ForeignFilesAndOtherVersionsAreDistinguished)
{
  coupling::write_reduced_frame(file, some_frame());
  std::string other           = bytes(file);
  other[other.find('\n') - 1] = '0'; // the number of the format ends the first line
  const auto says             = [&](const std::string &content, const std::string &words)
  {
    std::ofstream(file, std::ios::binary) << content;
    const std::string said = tests::refusal([&] { coupling::read_reduced_frame(file); });
    EXPECT_NE(said.find(words), std::string::npos) << said;
    EXPECT_NE(said.find("gestell reduce"), std::string::npos) << said;
  };
  says(other, "another version");
  says("\x89HDF\r\n\x1a\n", "not a Gestell file, or one of an early version");
}

TEST_F(ReducedFrameFile, DamagedFilesAreRefused)
{
  EXPECT_THROW(coupling::read_reduced_frame(file), std::invalid_argument);
  coupling::write_reduced_frame(file, some_frame());
  const std::string whole = bytes(file);
  for (const std::size_t length : {std::size_t(0), std::size_t(100), whole.size() / 2, whole.size() - 1})
  {
    std::ofstream(file, std::ios::binary) << whole.substr(0, length);
    EXPECT_THROW(coupling::read_reduced_frame(file), std::invalid_argument) << length << " bytes";
  }
  std::ofstream(file) << "[frame]\n";
  EXPECT_THROW(coupling::read_reduced_frame(file), std::invalid_argument);
}

/// The seal of whoever forged it.
std::string sealed_anew(const std::string &bytes)
{
  constexpr std::size_t head = 512, digits = 64;
  const std::size_t     at = bytes.find("sha256 ") + 7;
  return bytes.substr(0, at) + coupling::Sha256().update(bytes.substr(head)).hexadecimal() + bytes.substr(at + digits);
}

/// Places of 8 bytes that may be an address within the file.
std::vector<std::size_t> addresses_in(const std::string &bytes)
{
  std::vector<std::size_t> places;
  for (std::size_t at = 512; at + 8 <= bytes.size(); at += 8)
  {
    std::uint64_t value;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    if (value >= 96 && value < bytes.size())
      places.push_back(at);
  }
  return places;
}

/// Counts the refusals when reading the file with one address after the other that leads nowhere; names and times are
/// addresses by chance only.
template <typename Refusal>
int refusals(const std::string &file, const std::function<std::string(const std::string &)> &sealed,
             const std::function<void(const std::string &)> &read)
{
  coupling::write_reduced_frame(file, some_frame());
  const std::string              whole  = bytes(file);
  const std::vector<std::size_t> places = addresses_in(whole);
  EXPECT_GT(places.size(), 100u);
  int refused = 0, n = 0;
  for (std::size_t i = 0; i < places.size(); i += i < 8 ? 1 : places.size() / 8) // the first are those of the root
    for (const std::uint64_t address : {std::uint64_t(8), std::uint64_t(1) << 40, ~std::uint64_t(0)})
    {
      std::string forged = whole;
      std::memcpy(forged.data() + places[i], &address, sizeof address);
      const std::string name = file + std::to_string(++n); // another one: a file is tried once as it is
      std::ofstream(name, std::ios::binary) << sealed(forged);
      try
      {
        read(name);
      }
      catch (const Refusal &)
      {
        ++refused;
      }
    }
  return refused;
}

TEST_F(ReducedFrameFile, ForgedAddressesAreAMessageWhateverTheLibraryDoes)
{
  // a signal ends HDF5 1.10 at some of them, which would end this test were they not read in a child
  const auto read = [](const std::string &name) { coupling::read_reduced_frame(name); };
  EXPECT_GT(refusals<std::invalid_argument>(file, sealed_anew, read), 10);
}

TEST_F(ReducedFrameFile, DamagedAddressesAreAMessageWhereTheChecksumIsNotAsked)
{
  const auto as_it_is = [](const std::string &damaged) { return damaged; };
  const auto read     = [](const std::string &name) { coupling::read_frame_summary(name); };
  EXPECT_GT(refusals<std::runtime_error>(file, as_it_is, read), 5);
}

TEST_F(ReducedFrameFile, HeadIsNotTakenForDamagedWhereTheLimitOfTimeIsNotANumber)
{
  coupling::write_reduced_frame(file, some_frame());
  setenv("GESTELL_READING_SECONDS", "often", 1);
  EXPECT_THROW(coupling::read_frame_summary(file), std::invalid_argument); // std::runtime_error: it is damaged
  unsetenv("GESTELL_READING_SECONDS");
}

TEST_F(ReducedFrameFile, PartsThatDoNotFitAreRefused)
{
  ReducedFrame frame = some_frame();
  frame.n_interface  = 4;
  coupling::write_reduced_frame(file, frame);
  EXPECT_THROW(coupling::read_reduced_frame(file), std::invalid_argument);
  frame                             = some_frame();
  frame.interfaces[0].coordinate[2] = 4;
  coupling::write_reduced_frame(file, frame);
  EXPECT_THROW(coupling::read_reduced_frame(file), std::invalid_argument);
}

TEST_F(ReducedFrameFile, HoldsNoPhysicalCoordinatesBehindTheInterface)
{
  auto frame  = some_frame();
  frame.modal = false;
  EXPECT_THROW(coupling::write_reduced_frame(file, frame), std::invalid_argument);
}

} // namespace
} // namespace gestell
