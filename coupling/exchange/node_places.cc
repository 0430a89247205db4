#include "coupling/exchange/node_places.h"

#include "coupling/exchange/bulk_cards.h"
#include "coupling/exchange/text_file.h"
#include "fem/values/inp_lines.h"
#include "fem/values/number_text.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <regex>
#include <set>
#include <vector>

namespace gestell::coupling
{

namespace
{

/**
 * Rectangular coordinate systems of a Nastran model (CORD2R), by their numbers; 0 is the basic one.
 *
 *     CORD2R, CID, RID, A1, A2, A3, B1, B2, B3, C1, C2, C3
 *
 * A is the origin, B a point of the z-axis, C one of the x-z-plane, all in the system RID.
 *
 * @throws std::invalid_argument with line: points on a line, systems that refer to each other in a circle.
 */
class CoordinateSystems
{
public:
  struct System
  {
    Eigen::Vector3d origin = Eigen::Vector3d::Zero();
    Eigen::Matrix3d axes   = Eigen::Matrix3d::Identity(); ///< x, y, z as columns, in the basic system
  };

  explicit CoordinateSystems(TextFile &file);

  /// Null if there is none, or one that is not rectangular.
  const System *find(long number) const;

private:
  struct Card
  {
    long                           reference, line;
    std::array<Eigen::Vector3d, 3> points;
  };
  /// The system, and those that it refers to.
  void resolve(const TextFile &file, long number);
  void add(const TextFile &file, long number, const Card &card, const System &reference);

  std::map<long, Card>   cards_;
  std::map<long, System> systems_;
  std::set<long>         without_place_; ///< based on one that is not rectangular, or missing
};

CoordinateSystems::CoordinateSystems(TextFile &file)
{
  constexpr std::size_t first_point = 2, last_field = 10; // fields of the card, from 0
  systems_[0] = {};
  file.restart();
  BulkCards cards(file, {"CORD2R"});
  while (cards.next())
  {
    auto field = cards.fields();
    field.resize(std::max(field.size(), last_field + 1));
    Card card;
    card.line      = cards.line();
    card.reference = field[1].empty() ? 0 : file.whole(field[1], "the number of a coordinate system");
    for (std::size_t i = 0; i < 9; ++i)
      card.points[i / 3][Eigen::Index(i % 3)] =
          field[first_point + i].empty() ? 0. : file.real(field[first_point + i], "a coordinate");
    cards_[file.whole(field[0], "the number of a coordinate system")] = card;
  }
  for (const auto &[number, card] : cards_)
    resolve(file, number);
  file.restart();
}

const CoordinateSystems::System *CoordinateSystems::find(long number) const
{
  const auto found = systems_.find(number);
  return found == systems_.end() ? nullptr : &found->second;
}

/// Without recursion, as a file may have chains of any length.
void CoordinateSystems::resolve(const TextFile &file, long number)
{
  std::vector<long> chain;
  std::set<long>    in_chain;
  for (auto card = cards_.find(number);
       systems_.count(number) == 0 && card != cards_.end() && without_place_.count(number) == 0;
       card = cards_.find(number))
  {
    if (!in_chain.insert(number).second)
      file.fail_at(card->second.line, "coordinate system " + std::to_string(number) + " refers to itself");
    chain.push_back(number);
    number = card->second.reference;
  }
  for (; !chain.empty(); chain.pop_back())
  {
    const Card &card = cards_.at(chain.back());
    if (const System *reference = find(card.reference))
      add(file, chain.back(), card, *reference);
    else // of one that is not rectangular, or missing
      without_place_.insert(chain.back());
  }
}

void CoordinateSystems::add(const TextFile &file, long number, const Card &card, const System &reference)
{
  const auto basic = [&](int i)
  { return Eigen::Vector3d(reference.origin + reference.axes * card.points[std::size_t(i)]); };
  const Eigen::Vector3d a = basic(0), z = (basic(1) - a).normalized(), y = z.cross((basic(2) - a).normalized());
  if (!a.allFinite() || !z.allFinite() || !y.allFinite())
    file.fail_at(card.line, "the points of coordinate system " + std::to_string(number) +
                                " are so far away that their distances are not finite; check its columns");
  constexpr double on_a_line = 1e-10; // sine of the angle at A: ten written digits
  if (!(y.norm() > on_a_line))
    file.fail_at(card.line, "the three points of coordinate system " + std::to_string(number) +
                                " are on a line, which leaves its axes undefined");
  System system;
  system.origin      = a;
  system.axes.col(2) = z;
  system.axes.col(1) = y.normalized();
  system.axes.col(0) = system.axes.col(1).cross(z);
  systems_[number]   = system;
}

/// Positions found so far; detects a second position of a node.
class Found
{
public:
  explicit Found(const std::set<long> &wanted) : wanted_(wanted) {}

  bool wants(long node) const { return wanted_.count(node) > 0; }

  /// @return whether the node had another position before
  bool contradicts(long node, const std::array<double, 3> &x)
  {
    const auto [place, is_new] = nodes_.places.emplace(node, x);
    return !is_new && place->second != x;
  }
  void turn(long node, const Eigen::Matrix3d &axes) { nodes_.axes[node] = axes; }

  const ModelNodes &nodes() const { return nodes_; }

private:
  const std::set<long> &wanted_;
  ModelNodes            nodes_;
};

std::string elsewhere(long node)
{
  return "node " + std::to_string(node) + " already has another position; remove one of them";
}

long number_of_system(const TextFile &file, std::string_view number)
{
  return number.empty() || number == "-1" ? 0 : file.whole(number, "the number of a coordinate system");
}

/// The system that CP or CD of a grid point names.
const CoordinateSystems::System &system_of(const TextFile &file, const BulkCards &card,
                                           const CoordinateSystems &systems, std::string_view number,
                                           const std::string &what)
{
  const long id = number_of_system(file, number);
  if (const auto *system = systems.find(id))
    return *system;
  file.fail_at(card.line(), "grid point " + std::string(card.fields()[0]) + " gives its " + what +
                                " in coordinate system " + std::to_string(id) +
                                ", which no CORD2R card of this file defines; only rectangular systems are supported: "
                                "write the point in the basic system, and the matrices with CD = 0 there");
}

void read_grids(const std::string &name, UnknownPlaces unknown, Found &found)
{
  constexpr std::size_t grid_id = 0, grid_cp = 1, grid_x = 2, grid_cd = 5; // fields of the card, from 0
  TextFile              file(name);
  std::string           usual_cp, usual_cd; // of GRDSET
  {
    BulkCards defaults(file, {"GRDSET"});
    while (defaults.next())
    {
      usual_cp = std::string(defaults.fields()[grid_cp]);
      if (defaults.fields().size() > grid_cd)
        usual_cd = std::string(defaults.fields()[grid_cd]);
    }
  }
  const CoordinateSystems systems(file);
  BulkCards               cards(file, {"GRID"});
  while (cards.next())
  {
    auto field = cards.fields();
    field.resize(std::max(field.size(), grid_cd + 1));
    const long node = file.whole(field[grid_id], "the number of a grid point");
    if (!found.wants(node))
      continue;
    const std::string_view cp = field[grid_cp].empty() ? std::string_view(usual_cp) : field[grid_cp],
                           cd = field[grid_cd].empty() ? std::string_view(usual_cd) : field[grid_cd];
    const auto &of_motion     = system_of(file, cards, systems, cd, "motions (CD)");
    if (&of_motion != systems.find(0))
      found.turn(node, of_motion.axes);
    if (unknown == UnknownPlaces::left_out && !systems.find(number_of_system(file, cp)))
      continue;
    const auto           &of_place = system_of(file, cards, systems, cp, "place (CP)");
    std::array<double, 3> x{};
    for (std::size_t d = 0; d < 3; ++d)
      if (!field[grid_x + d].empty()) // blank is 0
        x[d] = file.real(field[grid_x + d], "a coordinate");
    if (&of_place != systems.find(0))
    {
      const Eigen::Vector3d basic = of_place.origin + of_place.axes * Eigen::Vector3d(x[0], x[1], x[2]);
      x                           = {basic[0], basic[1], basic[2]};
      if (!basic.allFinite())
        file.fail_at(cards.line(), "the position of grid point " + std::to_string(node) + " is not finite");
    }
    if (found.contradicts(node, x))
      file.fail_at(cards.line(), elsewhere(node));
  }
}

class InpNodes
{
public:
  explicit InpNodes(Found &found) : found_(found) {}

  /// @param in_nodes  whether the first lines of the file are nodes
  void read(const std::string &name, bool in_nodes, int depth)
  {
    fem::InpLines lines(name);
    if (!lines.opened())
      throw std::invalid_argument(name + ": cannot be read; another file names it as INPUT, check its path");
    constexpr int most_files = 1000, deepest_file = 20; // that include each other: open files, and recursion
    if (depth > deepest_file || ++n_files_ > most_files)
      throw std::invalid_argument(
          name + ": is one of more than " + std::to_string(most_files) + " files, or " + std::to_string(deepest_file) +
          " levels of nested includes; check whether a file includes itself, or write one file");
    const auto refused = [&](const std::string &what)
    { return std::invalid_argument(name + ":" + std::to_string(lines.number()) + ": " + what); };
    std::string keyword_before;
    while (lines.next())
    {
      if (lines.is_keyword())
      {
        const fem::InpKeyword keyword = lines.keyword();
        if (keyword.name == "TRANSFORM")
          throw refused("*TRANSFORM rotates the directions of nodes and the rows of the matrices; only global "
                        "directions are supported, remove it");
        in_nodes       = keyword.name == "NODE";
        keyword_before = keyword.name;
        if (in_nodes && keyword.has("SYSTEM") && keyword["SYSTEM"] != "R" && keyword["SYSTEM"] != "r")
          throw refused("only nodes in rectangular systems are supported; write their x, y, z");
        if (const std::string other = fem::input_of(keyword, name);
            !other.empty() && (in_nodes || keyword.name == "INCLUDE"))
          read(other, in_nodes, depth + 1);
      }
      else if (in_nodes)
        add(lines, refused);
      else if (keyword_before == "SYSTEM" || keyword_before == "INSTANCE")
        require_not_moved(keyword_before, lines, refused);
    }
  }

private:
  template <typename Refused>
  void add(const fem::InpLines &lines, const Refused &refused)
  {
    const auto            fields = lines.fields();
    std::array<double, 3> x{};
    const auto            node = fields.empty() ? std::nullopt : whole_of(fields[0]);
    if (!node)
      throw refused("expected the number of a node and its x, y, z");
    for (std::size_t d = 0; d < 3 && d + 1 < fields.size(); ++d)
      if (!fields[d + 1].empty()) // blank is 0
      {
        const auto coordinate = real_of(fields[d + 1]);
        if (!coordinate || !std::isfinite(*coordinate))
          throw refused("'" + fields[d + 1] + "' is not a coordinate; expected the number of a node and its x, y, z");
        x[d] = *coordinate;
      }
    if (found_.wants(*node) && found_.contradicts(*node, x))
      throw refused(elsewhere(*node));
  }

  /// Refuses lines after *SYSTEM and *INSTANCE that move or rotate nodes; zeros pass.
  template <typename Refused>
  static void require_not_moved(const std::string &keyword, const fem::InpLines &lines, const Refused &refused)
  {
    const auto fields  = lines.fields();
    const auto is_zero = [](const std::string &field) { return field.empty() || real_of(field) == 0.; };
    if (!std::all_of(fields.begin(), fields.end(), is_zero))
      throw refused("*" + keyword +
                    " moves or rotates the nodes by this line; only positions in the global system are supported: "
                    "write the nodes there (Abaqus: a flat input file without parts), or give "
                    "a table with the columns node, x, y, z");
  }

  Found &found_;
  int    n_files_ = 0;
};

/// NBLOCK, then a format such as (3i9,6e21.13e3), then nodes until a line that begins with N or -1.
void read_nblocks(const std::string &name, Found &found)
{
  static const std::regex form("\\(\\s*([0-9]+)\\s*[iI]\\s*([0-9]+)\\s*,\\s*([0-9]+)\\s*[eE]\\s*([0-9]+)");
  TextFile                file(name);
  while (file.next())
  {
    if (!begins(file.line(), "NBLOCK"))
      continue;
    std::match_results<std::string_view::const_iterator> found_form;
    constexpr std::size_t                                longest_format = 80; // columns of a card
    const std::string_view line = file.next() ? file.line().substr(0, longest_format) : "";
    if (!std::regex_search(line.begin(), line.end(), found_form, form))
      file.fail("expected the format of the nodes, such as (3i9,6e21.13e3)");
    const auto number = [&](int i)
    {
      const auto     value        = whole_of(found_form[i].str());
      constexpr long longest_line = 10000; // columns, of a format: a number that is wrong would take all memory
      if (!value || *value < 1 || *value > longest_line)
        file.fail("'" + found_form[i].str() +
                  "' is not a number of columns; expected a format such as (3i9,6e21.13e3)");
      return std::size_t(*value);
    };
    const std::size_t integers = number(1), integer_width = number(2), width = number(4);
    while (file.next() && !begins(file.line(), "N") && trimmed(file.line()) != "-1")
    {
      const std::string_view line = file.line();
      const long             node = file.whole(line.substr(0, integer_width), "the number of a node");
      if (!found.wants(node))
        continue;
      std::array<double, 6> value{}; // x, y, z and three angles; zeros at the end may be left out
      for (std::size_t i = 0, at = integers * integer_width; i < 6 && at < line.size(); ++i, at += width)
        if (const auto field = trimmed(line.substr(at, width)); !field.empty())
          value[i] = file.real(field, "a coordinate");
      if (value[3] != 0. || value[4] != 0. || value[5] != 0.)
        file.fail("node " + std::to_string(node) +
                  " has DOFs in a system rotated relative to the global one; only "
                  "global directions are supported: rotate it back (NROTAT, NMODIF) before the matrices are written");
      if (found.contradicts(node, {value[0], value[1], value[2]}))
        file.fail(elsewhere(node));
    }
  }
}

enum class NodeKeyword
{
  none,
  grid,
  node,
  nblock
};

NodeKeyword node_keyword(const std::string &name)
{
  TextFile file(name);
  while (file.next())
  {
    const std::string_view line = file.line();
    if (line.empty())
      continue;
    if (line[0] == '*' && (begins(line, "*NODE,") || capitals(trimmed(line)) == "*NODE" || begins(line, "*INCLUDE")))
      return NodeKeyword::node;
    if (begins(line, "NBLOCK"))
      return NodeKeyword::nblock;
    if (begins(line, "GRID") && line.size() > 4 && std::string_view(" *,").find(line[4]) != std::string_view::npos)
      return NodeKeyword::grid;
  }
  return NodeKeyword::none;
}

} // namespace

ModelNodes read_model_nodes(const std::string &file, const std::set<long> &wanted, UnknownPlaces unknown)
{
  Found found(wanted);
  switch (node_keyword(file))
  {
  case NodeKeyword::grid:
    read_grids(file, unknown, found);
    break;
  case NodeKeyword::node:
    InpNodes(found).read(file, false, 0);
    break;
  case NodeKeyword::nblock:
    read_nblocks(file, found);
    break;
  case NodeKeyword::none:
    break;
  }
  return found.nodes();
}

std::string place_text(const std::array<double, 3> &x)
{
  return "[" + rounded(x[0]) + ", " + rounded(x[1]) + ", " + rounded(x[2]) + "] m";
}

bool has_node_places(const std::string &file)
{
  return node_keyword(file) != NodeKeyword::none;
}

} // namespace gestell::coupling
