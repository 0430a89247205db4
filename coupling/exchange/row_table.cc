#include "coupling/exchange/row_table.h"

#include "coupling/exchange/text_file.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace gestell::coupling
{

namespace
{

const std::array<std::string, 6> ansys_motions = {"UX", "UY", "UZ", "ROTX", "ROTY", "ROTZ"};

/// "12.3"
RowLabel node_and_direction(const TextFile &file, std::string_view word)
{
  const auto dot = word.find('.');
  if (dot == std::string_view::npos)
    file.fail("expected node.direction, such as 12.3");
  const long node      = file.node(word.substr(0, dot));
  const long direction = file.whole(word.substr(dot + 1), "a direction, 1 to 6");
  if (direction < 1 || direction > 6)
    file.fail("direction " + std::to_string(direction) + " is not a DOF: 1 to 3 are displacements, 4 to 6 rotations");
  return {node, int(direction)};
}

RowLabel node_and_motion(const TextFile &file, std::string_view node, std::string_view motion)
{
  const auto found = std::find(ansys_motions.begin(), ansys_motions.end(), capitals(motion));
  if (found == ansys_motions.end())
    file.fail("'" + std::string(motion) + "' is not a DOF of a frame; give UX, UY, UZ, ROTX, ROTY or ROTZ");
  return {file.node(node), int(found - ansys_motions.begin()) + 1};
}

void require_different(const TextFile &file, const std::vector<RowLabel> &rows)
{
  std::map<RowLabel, std::size_t> visited;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (const auto [first, is_new] = visited.emplace(rows[i], i); !is_new)
      file.fail_at_end(text_of(rows[i]) + " is row " + std::to_string(first->second + 1) + " and row " +
                       std::to_string(i + 1));
}

/// Rows by their numbers, which may come in any order.
class NumberedRows
{
public:
  explicit NumberedRows(const TextFile &file) : file_(file) {}

  void add(std::string_view number, const RowLabel &label)
  {
    const long row = file_.whole(number, "the number of a row");
    if (row < 1 || row > long(file_.size()))
      file_.fail("rows start at 1, and a file of this length has fewer");
    if (std::size_t(row) > rows_.size())
      rows_.resize(std::size_t(row));
    if (rows_[std::size_t(row) - 1].node != 0)
      file_.fail("row " + std::to_string(row) + " already exists");
    rows_[std::size_t(row) - 1] = label;
  }

  const std::vector<RowLabel> &complete() const
  {
    for (std::size_t i = 0; i < rows_.size(); ++i)
      if (rows_[i].node == 0)
        file_.fail_at_end("row " + std::to_string(i + 1) + " is missing");
    return rows_;
  }

private:
  const TextFile       &file_;
  std::vector<RowLabel> rows_;
};

} // namespace

std::vector<RowLabel> read_row_table(const std::string &name)
{
  TextFile              file(name);
  std::vector<RowLabel> listed;
  NumberedRows          numbered(file);
  bool                  has_numbers = false;
  while (file.next())
  {
    const auto words    = words_of(file.line());
    const bool is_title = !words.empty() && !std::isdigit(static_cast<unsigned char>(words[0][0]));
    if (words.empty() || (is_title && listed.empty() && !has_numbers))
      continue;
    if (words.size() == 1)
      listed.push_back(node_and_direction(file, words[0]));
    else if (words.size() == 3)
    {
      numbered.add(words[0], node_and_motion(file, words[1], words[2]));
      has_numbers = true;
    }
    else
      file.fail("expected 'node.direction' of CalculiX or 'row node motion' of Ansys, such as 12.3 or 5 12 UZ");
    if (has_numbers && !listed.empty())
      file.fail("lines of both forms are mixed");
  }
  if (has_numbers)
    listed = numbered.complete();
  if (listed.empty())
    file.fail_at_end("it names no row");
  require_different(file, listed);
  return listed;
}

} // namespace gestell::coupling
