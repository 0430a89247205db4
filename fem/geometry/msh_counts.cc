#include "fem/geometry/msh_counts.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <map>

namespace gestell::fem
{

namespace
{

using Count = std::uint64_t;

constexpr Count size_of_int = 4, size_of_count = 8, size_of_real = 8;

/// Nodes of gmsh's kinds of elements, up to order four.
const std::map<std::int32_t, Count> &nodes_of_kinds()
{
  static const std::map<std::int32_t, Count> nodes = {
      {1, 2},   {2, 3},   {3, 4},   {4, 4},   {5, 8},   {6, 6},   {7, 5},   {8, 3},   {9, 6},   {10, 9},  {11, 10},
      {12, 27}, {13, 18}, {14, 14}, {15, 1},  {16, 8},  {17, 20}, {18, 15}, {19, 13}, {21, 10}, {23, 15}, {26, 4},
      {27, 5},  {29, 20}, {30, 35}, {36, 16}, {37, 25}, {90, 40}, {91, 75}, {92, 64}, {93, 125}};
  return nodes;
}

/// The file ends where it should not, or is of a kind that is not known here.
struct Unknown
{
};

struct Defect
{
  std::string text;
};

class MshCounts
{
public:
  explicit MshCounts(const std::string &path) : in_(path, std::ios::binary)
  {
    in_.seekg(0, std::ios::end);
    size_ = in_ ? Count(in_.tellg()) : 0;
    in_.seekg(0);
  }

  void check()
  {
    if (!is_binary_41())
      return;
    swapped_ = number<std::int32_t>() != 1; // as gmsh takes it
    for (std::string line = next_line(); line.rfind("$Elements", 0) != 0; line = next_line())
      if (line.rfind("$Entities", 0) == 0)
        entities();
      else if (line.rfind("$PartitionedEntities", 0) == 0)
        partitioned_entities();
      else if (line.rfind("$Nodes", 0) == 0)
        nodes();
      else if (line.rfind("$End", 0) != 0 && line.rfind("$", 0) == 0)
        pass_section(line);
    elements();
  }

private:
  /// The start of the line, sufficient for names of sections.
  std::string next_line()
  {
    constexpr std::size_t kept = 64; // letters: lines that count are shorter
    std::string           text;
    int                   c = in_.get();
    for (; c != '\n' && c != EOF; c = in_.get())
      if (text.size() < kept)
        text += char(c);
    if (c == EOF && text.empty())
      throw Unknown{};
    return text;
  }

  void pass_section(const std::string &begin)
  {
    const std::string end = "$End" + begin.substr(1, begin.find_last_not_of(" \r"));
    while (next_line().rfind(end, 0) != 0)
    {
    }
  }

  bool is_binary_41()
  {
    std::string line = next_line();
    for (; line.rfind("$MeshFormat", 0) != 0; line = next_line())
      if (line.rfind("$", 0) == 0)
        pass_section(line);
    double        version = 0.;
    int           binary  = 0;
    unsigned long size    = 0;
    return std::sscanf(next_line().c_str(), "%lf %d %lu", &version, &binary, &size) == 3 && version >= 4.1 &&
           version < 5. && binary != 0 && size == size_of_count;
  }

  template <typename T>
  T number()
  {
    std::array<char, sizeof(T)> bytes{};
    if (!in_.read(bytes.data(), bytes.size()))
      throw Unknown{};
    if (swapped_)
      std::reverse(bytes.begin(), bytes.end());
    T value;
    std::memcpy(&value, bytes.data(), sizeof value);
    return value;
  }

  std::int32_t integer() { return number<std::int32_t>(); }

  Count place() { return Count(in_.tellg()); }

  /// Reads the number of `things`, each of at least the given number of bytes.
  Count count(const std::string &things, Count bytes)
  {
    const Count at   = place();
    const Count n    = number<Count>();
    const Count left = size_ - at - size_of_count;
    if (n > left / bytes)
      throw Defect{"is damaged: at byte " + std::to_string(at) + " it announces " + std::to_string(n) + " " + things +
                   ", of at least " + std::to_string(bytes) + " bytes each, but only " + std::to_string(left) +
                   " bytes follow; copy or export it again."};
    return n;
  }

  void pass(Count bytes) { in_.seekg(std::streamoff(bytes), std::ios::cur); }

  void tags(const std::string &things) { pass(count(things, size_of_int) * size_of_int); }

  /// Points, curves, surfaces and volumes: a head, their extents, physical groups and, except for points, boundaries.
  template <typename PassHead>
  void entities(Count head, const PassHead &pass_head)
  {
    static const std::array<const char *, 4> names = {"points", "curves", "surfaces", "volumes"};
    std::array<Count, 4>                     n;
    const auto extent = [](std::size_t dimension) { return (dimension == 0 ? 3 : 6) * size_of_real; };
    for (std::size_t dimension = 0; dimension < n.size(); ++dimension)
      n[dimension] = count(names[dimension], head + extent(dimension) + (dimension == 0 ? 1 : 2) * size_of_count);
    for (std::size_t dimension = 0; dimension < n.size(); ++dimension)
      for (Count i = 0; i < n[dimension]; ++i)
      {
        pass_head();
        pass(extent(dimension));
        tags("physical groups");
        if (dimension > 0)
          tags("boundaries");
      }
  }

  void entities()
  {
    entities(size_of_int, [this] { pass(size_of_int); });
  }

  void partitioned_entities()
  {
    pass(size_of_count);
    pass(count("ghost entities", 2 * size_of_int) * 2 * size_of_int);
    constexpr Count numbers = 3 * size_of_int; // of the entity and of the one it is a part of
    entities(numbers + size_of_count,
             [this]
             {
               pass(numbers);
               tags("partitions");
             });
  }

  /// Head of the blocks of nodes and of elements: number of blocks, total number, lowest and highest tag.
  struct Blocks
  {
    Count n, in_all, at, found = 0;
  };

  Blocks blocks(const std::string &things, Count bytes)
  {
    Blocks blocks;
    blocks.n      = count("blocks of " + things, 3 * size_of_int + size_of_count);
    blocks.at     = place();
    blocks.in_all = count(things, bytes);
    pass(2 * size_of_count);
    return blocks;
  }

  /// Adds to the number found. A smaller number than announced is valid: gmsh may announce more.
  static void add(Blocks &blocks, Count n, const std::string &things)
  {
    if ((blocks.found += n) > blocks.in_all)
      throw Defect{"is damaged: at byte " + std::to_string(blocks.at) + " it announces " +
                   std::to_string(blocks.in_all) + " " + things + ", but its blocks hold " +
                   std::to_string(blocks.found) + " and more; copy or export it again."};
  }

  void nodes()
  {
    constexpr Count node = size_of_count + 3 * size_of_real;
    Blocks          all  = blocks("nodes", node);
    for (Count i = 0; i < all.n; ++i)
    {
      const std::int32_t dimension = integer();
      pass(size_of_int);
      const bool parametric = integer() != 0;
      if (dimension < 0 || dimension > 3)
        throw Unknown{};
      const Count own = node + (parametric ? Count(dimension) * size_of_real : 0), n = count("nodes", own);
      add(all, n, "nodes");
      pass(n * own);
    }
  }

  void elements()
  {
    Blocks all = blocks("elements", 2 * size_of_count);
    for (Count i = 0; i < all.n; ++i)
    {
      pass(2 * size_of_int);
      const auto  kind  = nodes_of_kinds().find(integer());
      const bool  known = kind != nodes_of_kinds().end();
      const Count own = (1 + (known ? kind->second : 1)) * size_of_count, n = count("elements", own);
      add(all, n, "elements");
      if (!known)
        throw Unknown{};
      pass(n * own);
    }
  }

  std::ifstream in_;
  Count         size_    = 0;
  bool          swapped_ = false;
};

} // namespace

std::string defect_of_counts(const std::string &path)
{
  try
  {
    MshCounts(path).check();
  }
  catch (const Unknown &)
  {
  }
  catch (const Defect &found)
  {
    return found.text;
  }
  return "";
}

} // namespace gestell::fem
