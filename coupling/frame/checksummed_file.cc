#include "coupling/frame/checksummed_file.h"

#include "coupling/frame/atomic_file.h"
#include "coupling/frame/sha256.h"

#include <fstream>

namespace gestell::coupling
{

namespace
{

constexpr std::size_t head_size = 512; // HDF5 searches its header here, and at byte 0

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

/// The header of the file; empty if there is no file, shorter than a header if the file is.
std::string read_head(std::ifstream &in)
{
  std::string head(head_size, '\0');
  in.read(head.data(), head_size);
  head.resize(std::size_t(in.gcount()));
  return head;
}

std::string defect_of(const std::string &head, const std::string &title)
{
  if (head.empty())
    return "cannot be read, or is empty";
  const std::string first_line = head.substr(0, head.find('\n'));
  if (first_line.compare(0, family(title).size(), family(title)) != 0)
    return "does not begin with '" + title + "': not a Gestell file, or one of an early version";
  if (first_line != title)
    return "has another version of the format: '" + first_line.substr(0, 60) + "', and this program reads '" + title +
           "'";
  return head.size() < head_size ? "is damaged: it ends within its header" : "";
}

} // namespace

void write_sealed(const std::string &file, const std::string &title, const std::string &content)
{
  const std::string head = head_of(title, Sha256().update(content).hexadecimal());
  AtomicFile        out(file);
  out.stream().write(head.data(), std::streamsize(head.size()));
  out.stream().write(content.data(), std::streamsize(content.size()));
  out.finish();
}

std::string head_defect(const std::string &file, const std::string &title)
{
  std::ifstream in(file, std::ios::binary);
  return defect_of(read_head(in), title);
}

std::string seal_defect(const std::string &file, const std::string &title)
{
  std::ifstream     in(file, std::ios::binary);
  const std::string head = read_head(in);
  if (const std::string defect = defect_of(head, title); !defect.empty())
    return defect;
  // Reads through the same handle, because the name may by now belong to another file.
  if (head != head_of(title, sha256_of(in)))
    return "is damaged: its content does not match its checksum";
  return {};
}

} // namespace gestell::coupling
