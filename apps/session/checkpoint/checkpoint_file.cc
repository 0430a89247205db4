#include "apps/session/checkpoint/checkpoint_file.h"

#include "coupling/frame/atomic_file.h"
#include "coupling/frame/sha256.h"

#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

namespace gestell::apps
{

namespace
{

namespace fs = std::filesystem;

const char *const first_line = "gestell checkpoint 1";
const char *const way_out    = "; start it again without --resume";

[[noreturn]] void refuse(const fs::path &file, const std::string &why)
{
  throw std::invalid_argument("--resume: " + file.string() + ' ' + why + way_out);
}

std::string hash_of(const std::string &bytes)
{
  return coupling::Sha256().update(bytes).hexadecimal();
}

} // namespace

void write_checkpoint(const fs::path &file, const std::vector<KeyPart> &key, const std::string &state)
{
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  coupling::AtomicFile whole(file.string());
  whole.stream() << first_line << '\n';
  for (const KeyPart &part : key)
    whole.stream() << part.hash << ' ' << part.what << '\n';
  whole.stream() << hash_of(state) << " state\n" << state;
  whole.finish();
}

std::string read_checkpoint(const fs::path &file, const std::vector<KeyPart> &key)
{
  std::ifstream in(file, std::ios::binary);
  if (!in)
    refuse(file, "does not exist: no run of this scene was stopped in that folder, or the run was completed");
  std::string line;
  if (!std::getline(in, line) || line != first_line)
    refuse(file, "is not a checkpoint of this program");
  for (const KeyPart &part : key)
    if (!std::getline(in, line))
      refuse(file, "is damaged");
    else if (line != part.hash + ' ' + part.what)
      refuse(file, "is of another run: " + part.what + " has changed since");
  std::getline(in, line);
  const std::string state{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (line != hash_of(state) + " state")
    refuse(file, "is damaged");
  return state;
}

} // namespace gestell::apps
