#include "fem/geometry/msh_counts.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <map>

namespace gestell::fem
{

namespace
{

using Count = std::uint64_t;

constexpr Count size_of_int = 4, size_of_count = 8, size_of_real = 8;

/// Nodes of gmsh's kinds of elements.
const std::map<std::int32_t, Count> &nodes_of_kinds()
{
  static const std::map<std::int32_t, Count> nodes = {
      {1, 2},   {2, 3},   {3, 4},   {4, 4},   {5, 8},  {6, 6},  {7, 5},   {8, 3},   {9, 6},  {10, 9},
      {11, 10}, {12, 27}, {13, 18}, {14, 14}, {15, 1}, {16, 8}, {17, 20}, {18, 15}, {19, 13}};
  return nodes;
}

/// What is read of the file ends before it should, or is of a kind that is not known here.
struct Unknown
{
};

class MshCounts
{
public:
  MshCounts(const std::string &path, const std::function<void(const std::string &)> &refuse)
      : in_(path, std::ios::binary), refuse_(refuse)
  {
    in_.seekg(0, std::ios::end);
    size_ = in_ ? Count(in_.tellg()) : 0;
    in_.seekg(0);
  }

  void check()
  {
    if (line() != "$MeshFormat" || !is_binary(line()))
      return;
    if (number<std::int32_t>() != 1) // bytes in the order of another processor
      return;
    std::string section;
    while (next_section(section))
      if (section == "$Entities")
        entities();
      else if (section == "$Nodes")
        nodes();
      else if (section == "$Elements")
        elements();
  }

private:
  static bool is_binary(const std::string &format) { return format.rfind("4.1 1 8", 0) == 0; }

  std::string line()
  {
    constexpr std::size_t longest = 256; // between sections there are none but short ones
    std::string           text;
    for (int c = in_.get(); c != '\n'; c = in_.get())
      if (c == EOF || text.size() == longest)
        throw Unknown{};
      else
        text += char(c);
    if (!text.empty() && text.back() == '\r')
      text.pop_back();
    return text;
  }

  /// Goes to the first line behind the name of the next section; "$EndNodes" and the like begin none.
  bool next_section(std::string &name)
  {
    while (in_.peek() != EOF)
    {
      in_.ignore(std::streamsize(size_), '$');
      if (!in_ || in_.eof())
        return false;
      name = "$" + line();
      if (name.rfind("$End", 0) != 0)
        return true;
    }
    return false;
  }

  template <typename T>
  T number()
  {
    std::array<char, sizeof(T)> bytes{};
    if (!in_.read(bytes.data(), bytes.size()))
      throw Unknown{};
    T value;
    std::memcpy(&value, bytes.data(), sizeof value);
    return value;
  }

  std::int32_t integer() { return number<std::int32_t>(); }

  /// A number of `things` that take so many bytes each, at least.
  Count count(const std::string &things, Count bytes)
  {
    const Count at   = Count(in_.tellg());
    const Count n    = number<Count>();
    const Count left = size_ - at - size_of_count;
    if (n > left / bytes)
      refuse_("is damaged: at byte " + std::to_string(at) + " it announces " + std::to_string(n) + " " + things +
              ", but only " + std::to_string(left) + " bytes follow; copy or export it again.");
    return n;
  }

  void pass(Count bytes) { in_.seekg(std::streamoff(bytes), std::ios::cur); }

  void tags(const std::string &things) { pass(count(things, size_of_int) * size_of_int); }

  void entities()
  {
    constexpr Count            point = size_of_int + 3 * size_of_real + size_of_count;
    constexpr Count            other = size_of_int + 6 * size_of_real + 2 * size_of_count;
    const std::array<Count, 4> n     = {count("points", point), count("curves", other), count("surfaces", other),
                                        count("volumes", other)};
    for (std::size_t dimension = 0; dimension < n.size(); ++dimension)
      for (Count i = 0; i < n[dimension]; ++i)
      {
        pass(size_of_int + (dimension == 0 ? 3 : 6) * size_of_real);
        tags("physical groups of an entity");
        if (dimension > 0)
          tags("boundaries of an entity");
      }
  }

  /// What heads the blocks of nodes and elements: their number, that of all nodes or elements, the lowest and the
  /// highest tag.
  Count blocks(const std::string &things, Count block, Count bytes)
  {
    const Count n = count("blocks of " + things, block);
    count(things, bytes);
    pass(2 * size_of_count);
    return n;
  }

  void nodes()
  {
    constexpr Count node = size_of_count + 3 * size_of_real;
    const Count     n    = blocks("nodes", 3 * size_of_int + size_of_count, node);
    for (Count i = 0; i < n; ++i)
    {
      pass(2 * size_of_int);
      const bool  parametric = integer() != 0;
      const Count n_nodes    = count("nodes", node);
      if (parametric)
        throw Unknown{};
      pass(n_nodes * node);
    }
  }

  void elements()
  {
    const Count n = blocks("elements", 3 * size_of_int + size_of_count, 2 * size_of_count);
    for (Count i = 0; i < n; ++i)
    {
      pass(2 * size_of_int);
      const auto  kind       = nodes_of_kinds().find(integer());
      const bool  known      = kind != nodes_of_kinds().end();
      const Count element    = (1 + (known ? kind->second : 1)) * size_of_count;
      const Count n_elements = count("elements", element);
      if (!known)
        throw Unknown{};
      pass(n_elements * element);
    }
  }

  std::ifstream                                   in_;
  const std::function<void(const std::string &)> &refuse_;
  Count                                           size_ = 0;
};

} // namespace

void check_msh_counts(const std::string &path, const std::function<void(const std::string &)> &refuse)
{
  try
  {
    MshCounts(path, refuse).check();
  }
  catch (const Unknown &)
  {
  }
}

} // namespace gestell::fem
