#include "coupling/sealed_file.h"

#include "coupling/sha256.h"

#include <fstream>
#include <stdexcept>

namespace gestell::coupling
{

namespace
{

constexpr int head_size = 512; // where HDF5 looks for its own beginning, beside the first byte

std::string head_of(const std::string &title, const std::string &hash)
{
  std::string head = title + "\nsha256 " + hash + "\n";
  head.resize(head_size, '\n');
  return head;
}

/// The title up to its last word, the version.
std::string family(const std::string &title)
{
  return title.substr(0, title.rfind(' ') + 1);
}

} // namespace

void write_sealed(const std::string &file, const std::string &title, const std::string &content)
{
  const std::string head = head_of(title, Sha256().update(content).hexadecimal());
  std::ofstream     out(file, std::ios::binary);
  out.write(head.data(), std::streamsize(head.size()));
  out.write(content.data(), std::streamsize(content.size()));
  out.close();
  if (!out)
    throw std::runtime_error("the folder cannot be written to, or the disk is full");
}

std::string seal_defect(const std::string &file, const std::string &title)
{
  std::string   head(head_size, '\0');
  std::ifstream in(file, std::ios::binary);
  if (!in)
    return "cannot be read";
  in.read(head.data(), head_size);
  const std::string first_line = head.substr(0, head.find('\n'));
  if (first_line.compare(0, family(title).size(), family(title)) != 0)
    return "does not begin with '" + title + "': a foreign file, or one of an early version";
  if (first_line != title)
    return "has another version of the format: '" + first_line.substr(0, 60) + "', and this program reads '" + title +
           "'";
  // Through the same handle: the name may belong to another file by now.
  if (in.gcount() < head_size || head != head_of(title, sha256_of(in)))
    return "is damaged: its content is not what its checksum says";
  return {};
}

} // namespace gestell::coupling
