#include "coupling/exchange/element_matrix.h"

#include "coupling/exchange/text_file.h"

#include <algorithm>
#include <set>

namespace gestell::coupling
{

namespace
{

/// The fields between commas, without blanks and without an empty last field.
std::vector<std::string_view> fields_of(std::string_view line)
{
  std::vector<std::string_view> fields;
  for (std::size_t at = 0; at <= line.size();)
  {
    const std::size_t end = std::min(line.find(',', at), line.size());
    fields.push_back(trimmed(line.substr(at, end - at)));
    at = end + 1;
  }
  while (!fields.empty() && fields.back().empty())
    fields.pop_back();
  return fields;
}

/// The value of a key, such as "STIFFNESS" in "*MATRIX, TYPE=STIFFNESS".
std::string value_of(std::string_view line, const std::string &key)
{
  for (const std::string_view field : fields_of(line))
    if (const auto equals = field.find('='); equals != std::string_view::npos)
      if (capitals(trimmed(field.substr(0, equals))) == key)
        return capitals(trimmed(field.substr(equals + 1)));
  return "";
}

class ElementReader
{
public:
  explicit ElementReader(const std::string &name) : file_(name) {}

  std::map<std::string, LabelledMatrix> read()
  {
    std::map<std::string, LabelledMatrix> matrices;
    bool                                  is_there = file_.next();
    while (is_there)
      if (is("*MATRIX"))
        is_there = read_matrix(matrices);
      else if (is("*USER ELEMENT") || is("*USERELEMENT"))
        is_there = read_element();
      else
        is_there = file_.next();
    return matrices;
  }

private:
  bool is(std::string_view keyword) const { return begins(trimmed(file_.line()), keyword); }
  bool is_remark() const { return trimmed(file_.line()).substr(0, 2) == "**"; }

  /// Reads nodes from the remark and directions from the following lines.
  bool read_element()
  {
    if (!rows_.empty())
      file_.fail("a second element begins here; a file with one substructure is needed");
    std::vector<long> nodes;
    bool              in_nodes = false, is_there;
    std::size_t       position = 0;
    std::vector<int>  directions;
    while ((is_there = file_.next()))
    {
      const std::string_view line = trimmed(file_.line());
      if (is_remark())
      {
        if (capitals(line).find("ELEMENT NODES") != std::string::npos)
          in_nodes = true;
        else if (in_nodes)
          for (const std::string_view field : fields_of(line.substr(2)))
            nodes.push_back(file_.node(field));
        continue;
      }
      in_nodes = false;
      if (line.empty())
        continue;
      if (line[0] == '*')
        break;
      const auto  fields = fields_of(line);
      std::size_t from   = 0;
      if (fields.empty()) // only commas
        continue;
      if (nodes.empty())
        file_.fail("directions precede their nodes; expected a comment '** ELEMENT NODES' with their "
                   "numbers, as CalculiX and Abaqus write it");
      if (!directions.empty()) // of a node further on
      {
        const long to = file_.whole(fields[0], "the position of a node in the element");
        if (to <= long(position) || to > long(nodes.size()))
          file_.fail("the element has nodes 1 to " + std::to_string(nodes.size()) + ", in ascending order");
        add_rows(nodes, position, std::size_t(to - 1), directions);
        position = std::size_t(to - 1);
        from     = 1;
      }
      directions.clear();
      constexpr std::size_t most_directions = 6; // of a node: else nodes times directions would fill the memory
      if (fields.size() - from > most_directions)
        file_.fail("a node has " + std::to_string(fields.size() - from) + " directions; a node has at most 6 DOFs");
      for (; from < fields.size(); ++from)
        directions.push_back(direction(fields[from]));
    }
    add_rows(nodes, position, nodes.size(), directions);
    require_different_rows();
    return is_there;
  }

  int direction(std::string_view field) const
  {
    const long d = file_.whole(field, "a direction, 1 to 6");
    if (d < 1 || d > 6)
      file_.fail("direction " + std::to_string(d) + " is not a DOF: 1 to 3 are displacements, 4 to 6 rotations");
    return int(d);
  }

  void add_rows(const std::vector<long> &nodes, std::size_t from, std::size_t to, const std::vector<int> &directions)
  {
    for (; from < to; ++from)
      for (const int d : directions)
        rows_.push_back({nodes[from], d});
  }

  void require_different_rows() const
  {
    std::set<RowLabel> visited;
    for (const RowLabel &row : rows_)
      if (!visited.insert(row).second)
        file_.fail(text_of(row) + " is twice in the element");
  }

  bool read_matrix(std::map<std::string, LabelledMatrix> &matrices)
  {
    const std::string type   = value_of(file_.line(), "TYPE");
    const std::size_t n      = rows_.size();
    const long        header = file_.number();
    if (n == 0)
      file_.fail("a matrix precedes its *USER ELEMENT, which defines its rows");
    if (type.empty() || matrices.count(type) > 0)
      file_.fail(type.empty() ? "expected TYPE=STIFFNESS or TYPE=MASS" : type + " is given twice");
    std::vector<FileEntry> entries;
    std::size_t            row = 0, column = 0;
    bool                   is_there;
    while ((is_there = file_.next()) && (is_remark() || file_.line().substr(0, 1) != "*"))
      for (const std::string_view field : is_remark() ? std::vector<std::string_view>{} : fields_of(file_.line()))
      {
        if (row == n)
          file_.fail("there are more numbers than in the lower triangle of " + std::to_string(n) + " rows");
        entries.push_back({int(row), int(column), file_.real(field, "an entry"), file_.number()});
        if (++column > row)
        {
          ++row;
          column = 0;
        }
      }
    if (row < n)
      file_.fail_at(header, "the lower triangle of " + std::to_string(n) + " rows has " +
                                std::to_string(n * (n + 1) / 2) + " numbers, but " + std::to_string(entries.size()) +
                                " follow; the file is truncated");
    matrices[type] = {assembled(file_, std::move(entries), int(n), Triangles::one, rows_), rows_};
    return is_there;
  }

  TextFile              file_;
  std::vector<RowLabel> rows_;
};

} // namespace

std::map<std::string, LabelledMatrix> read_element_matrices(const std::string &file)
{
  return ElementReader(file).read();
}

bool has_element_matrix(TextFile &file)
{
  bool has = false;
  file.restart();
  while (!has && file.next())
    has = file.line().substr(0, 1) == "*" && begins(file.line(), "*MATRIX") && !value_of(file.line(), "TYPE").empty();
  file.restart();
  return has;
}

} // namespace gestell::coupling
