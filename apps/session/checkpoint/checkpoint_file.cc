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

std::string hash_of(const std::string &bytes)
{
  return coupling::Sha256().update(bytes).hexadecimal();
}

} // namespace

std::string checkpoint_text(const std::vector<KeyPart> &key, const std::string &state)
{
  std::string text = std::string(first_line) + '\n';
  for (const KeyPart &part : key)
    text += part.hash + ' ' + part.what + '\n';
  return text + hash_of(state) + " state\n" + state;
}

void write_checkpoint(const fs::path &file, const std::vector<KeyPart> &key, const std::string &state)
{
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  coupling::AtomicFile whole(file.string());
  whole.stream() << checkpoint_text(key, state);
  whole.finish();
}

std::string read_checkpoint(const fs::path &file, const std::vector<KeyPart> &key, const std::string &reader,
                            const std::string &remedy)
{
  const auto refuse = [&](const std::string &why)
  { throw std::invalid_argument(reader + ": " + file.string() + ' ' + why + "; " + remedy); };
  std::ifstream in(file, std::ios::binary);
  if (!in)
    refuse("does not exist: no run of this scene was stopped in that folder, or the run was completed");
  std::string line;
  if (!std::getline(in, line) || line != first_line)
    refuse("is not a checkpoint of this program");
  for (const KeyPart &part : key)
    if (!std::getline(in, line))
      refuse("is damaged");
    else if (line != part.hash + ' ' + part.what)
      refuse("is of another run: " + part.what + " has changed since");
  std::getline(in, line);
  const std::string state{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (line != hash_of(state) + " state")
    refuse("is damaged");
  return state;
}

} // namespace gestell::apps
