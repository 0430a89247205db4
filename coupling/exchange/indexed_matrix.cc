#include "coupling/exchange/indexed_matrix.h"

#include "coupling/exchange/text_file.h"

#include <algorithm>

namespace gestell::coupling
{

namespace
{

constexpr const char *form = "'row column value'";

/// Whether the first line is a head: no row or column is larger, and the value is the number of further lines.
bool is_head(std::string_view value, const std::vector<FileEntry> &entries)
{
  const auto &first    = entries.front();
  const auto  is_small = [&](const FileEntry &e) { return e.row <= first.row && e.column <= first.column; };
  return entries.size() > 1 && whole_of(value) == long(entries.size() - 1) &&
         std::all_of(entries.begin(), entries.end(), is_small);
}

} // namespace

LabelledMatrix read_indexed_matrix(const std::string &name)
{
  TextFile               file(name);
  constexpr std::size_t  shortest_diagonal = 6; // bytes of "1 1 1\n": every row has an entry
  const long             most              = long(file.size() / shortest_diagonal) + 1;
  std::vector<FileEntry> entries;
  entries.reserve(file.size() / 40);
  long        n     = 0;
  bool        below = false, above = false;
  std::string first_value;
  while (file.next())
  {
    const std::string_view line  = trimmed(file.line());
    const auto             first = line.find_first_of(" \t");
    if (line.empty())
      continue;
    const std::string_view rest   = first == std::string_view::npos ? line.substr(0, 0) : trimmed(line.substr(first));
    const auto             second = rest.find_first_of(" \t");
    if (second == std::string_view::npos)
      file.fail(std::string("expected ") + form + "; the file may be truncated");
    const long row = file.whole(line.substr(0, first), form), column = file.whole(rest.substr(0, second), form);
    if (row < 1 || column < 1 || row > most || column > most)
      file.fail("rows and columns start at 1, and a file of this length has at most " + std::to_string(most) +
                ", each with an entry on the diagonal");
    entries.push_back({int(row - 1), int(column - 1), file.real(rest.substr(second), form), file.number()});
    if (entries.size() == 1)
      first_value = rest.substr(second);
    n = std::max({n, row, column});
    (row > column ? below : above) |= row != column;
  }
  if (entries.empty())
    file.fail_at_end(std::string("it has no entry; expected lines ") + form);
  if (is_head(first_value, entries))
    file.fail_at(entries.front().line,
                 "is a header line 'rows columns entries', which this format does not have; remove it, or write "
                 "'%%MatrixMarket matrix coordinate real symmetric' above it");
  const auto triangles = below && above ? Triangles::both : Triangles::one;
  return {assembled(file, std::move(entries), int(n), triangles, {})};
}

bool is_indexed_matrix(TextFile &file)
{
  file.restart();
  bool is = false;
  while (file.next())
    if (const auto words = words_of(file.line()); !words.empty())
    {
      const auto digits = [](std::string_view word)
      { return word.find_first_not_of("0123456789") == std::string_view::npos; };
      is = words.size() == 3 && digits(words[0]) && digits(words[1]);
      break;
    }
  file.restart();
  return is;
}

} // namespace gestell::coupling
