#include "coupling/exchange/dmig.h"

#include "coupling/exchange/bulk_cards.h"
#include "coupling/frame/atomic_file.h"

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <ostream>
#include <set>

namespace gestell::coupling
{

namespace
{

/// fields of the header card, from 0
constexpr std::size_t header_name = 0, header_zero = 1, header_form = 2, header_type = 3;
/// fields of a card of entries
constexpr std::size_t column_node = 1, column_component = 2, first_entry = 4, entry_fields = 4;
/// IFO of the header card
constexpr long square = 1, rectangular = 2, symmetric = 6, rectangular_by_numbers = 9;
constexpr long first_complex = 3, last_type = 4; ///< TIN of the header card: 1 and 2 are real, 3 and 4 complex

/// Entries of one matrix; rows are numbered in order of appearance.
struct Collected
{
  bool                    is_symmetric = false, is_left_out = false;
  std::map<RowLabel, int> number;
  std::vector<RowLabel>   rows;
  std::vector<FileEntry>  entries;

  int row(const RowLabel &label)
  {
    const auto [place, is_new] = number.emplace(label, int(rows.size()));
    if (is_new)
      rows.push_back(label);
    return place->second;
  }
};

class DmigReader
{
public:
  explicit DmigReader(const std::string &name) : file_(name) {}

  std::map<std::string, LabelledMatrix> read()
  {
    read_points();
    file_.restart();
    BulkCards cards(file_, {"DMIG"});
    while (cards.next())
      take(cards);
    std::map<std::string, LabelledMatrix> matrices;
    for (auto &[name, matrix] : collected_)
      if (!matrix.is_left_out)
        matrices.emplace(name, in_order(matrix));
    return matrices;
  }

private:
  /// Reads SPOINT, 1001, 1002 or SPOINT, 1001, THRU, 1010.
  void read_points()
  {
    BulkCards cards(file_, {"SPOINT"});
    while (cards.next())
    {
      const auto &field = cards.fields();
      for (std::size_t i = 0; i < field.size(); ++i)
        if (capitals(field[i]) == "THRU" && i > 0 && i + 1 < field.size())
          add_range(file_.whole(field[i - 1], point), file_.whole(field[i + 1], point));
        else if (!field[i].empty())
          points_.insert(file_.whole(field[i], point));
    }
  }

  /// Adds a range of points and joins it with overlapping ones, so that a search finds the range of a point.
  void add_range(long first, long last)
  {
    if (last < first)
      return;
    auto next = through_.upper_bound(first);
    if (next != through_.begin() && std::prev(next)->second >= first)
      --next;
    while (next != through_.end() && next->first <= last)
    {
      first = std::min(first, next->first);
      last  = std::max(last, next->second);
      next  = through_.erase(next);
    }
    through_.emplace(first, last);
  }

  bool is_point(long id) const
  {
    const auto after = through_.upper_bound(id);
    return points_.count(id) > 0 || (after != through_.begin() && id <= std::prev(after)->second);
  }

  RowLabel label(const BulkCards &cards, std::size_t at) const
  {
    const auto &field     = cards.fields();
    const long  node      = whole(cards, at, "the number of a grid or scalar point");
    const long  component = field[at + 1].empty() ? 0 : whole(cards, at + 1, "its component, 0 to 6");
    if (node < 1)
      file_.fail_at(cards.lines()[at], "there is no point " + std::to_string(node) + "; numbers of points start at 1");
    if (component < 0 || component > 6)
      file_.fail_at(cards.lines()[at], "component " + std::to_string(component) + " of point " + std::to_string(node) +
                                           " does not exist: 1 to 6 are DOFs of a grid point, 0 is a scalar point");
    return {node, is_point(node) ? 0 : int(component)};
  }

  void take(const BulkCards &cards)
  {
    const auto &field = cards.fields();
    if (field[header_name].empty())
      file_.fail_at(cards.line(), "a DMIG card has no matrix name");
    const std::string name = capitals(field[header_name]);
    if (field[header_zero] == "0")
      return take_header(cards, name);
    const auto known = collected_.find(name);
    if (known == collected_.end())
      file_.fail_at(cards.line(), "a column of " + name + " precedes its header DMIG, " + name +
                                      ", 0, IFO, TIN, TOUT; the beginning of the file may be missing");
    if (!known->second.is_left_out)
      take_column(cards, name, known->second);
  }

  void take_header(const BulkCards &cards, const std::string &name)
  {
    const long form = whole(cards, header_form, "IFO: 1 square, 6 symmetric");
    const long type = whole(cards, header_type, "TIN: 1 real, 2 real in double precision");
    if (form != square && form != symmetric && form != rectangular && form != rectangular_by_numbers)
      file_.fail_at(cards.line(), name + " has the form (IFO) " + std::to_string(form) +
                                      "; 1 is square, 6 symmetric, 2 and 9 rectangular");
    Collected matrix;
    matrix.is_symmetric = form == symmetric;
    matrix.is_left_out  = form == rectangular || form == rectangular_by_numbers;
    if (!matrix.is_left_out && (type < 1 || type > last_type))
      file_.fail_at(cards.line(), name + " has the type (TIN) " + std::to_string(type) + "; 1 and 2 are real");
    if (!matrix.is_left_out && type >= first_complex)
      file_.fail_at(cards.line(), name + " is complex (TIN " + std::to_string(type) +
                                      "); real matrices are needed. Export stiffness and damping separately, as real "
                                      "matrices: structural damping as K4AAX, or omit it and give 'damping'");
    if (!collected_.emplace(name, std::move(matrix)).second)
      file_.fail_at(cards.line(), name + " has a header already; each matrix needs its own name");
  }

  void take_column(const BulkCards &cards, const std::string &name, Collected &matrix)
  {
    const auto &field  = cards.fields();
    const int   column = matrix.row(label(cards, column_node));
    for (std::size_t at = first_entry; at + 2 < field.size(); at += entry_fields)
    {
      const bool is_blank = field[at].empty() && field[at + 1].empty() && field[at + 2].empty();
      if (is_blank)
        continue;
      const long line = cards.lines()[at];
      if (field[at + 2].empty())
        file_.fail_at(line, "the entry of " + name + " for point " + std::string(field[at]) +
                                " has no value; the file is truncated, or its columns are shifted");
      if (at + 3 < field.size() && !field[at + 3].empty() && file_.real(field[at + 3], "an imaginary part") != 0.)
        file_.fail_at(line, "an entry of " + name + " has an imaginary part; real matrices are needed");
      matrix.entries.push_back({matrix.row(label(cards, at)), column, real(cards, at + 2), line});
    }
  }

  long whole(const BulkCards &cards, std::size_t at, const char *what) const
  {
    if (cards.fields()[at].empty())
      file_.fail_at(cards.lines()[at], std::string("expected ") + what + ", but the field is blank");
    return file_.whole(cards.fields()[at], what);
  }

  double real(const BulkCards &cards, std::size_t at) const { return file_.real(cards.fields()[at], "an entry"); }

  LabelledMatrix in_order(Collected &matrix) const
  {
    std::vector<RowLabel> rows = matrix.rows;
    std::sort(rows.begin(), rows.end());
    const std::vector<int> place = places_of(matrix.rows, rows);
    for (FileEntry &entry : matrix.entries)
    {
      entry.row    = place[std::size_t(entry.row)];
      entry.column = place[std::size_t(entry.column)];
    }
    const auto triangles = matrix.is_symmetric ? Triangles::one : Triangles::both;
    return {assembled(file_, std::move(matrix.entries), int(rows.size()), triangles, rows), rows};
  }

  static constexpr const char *point = "the number of a scalar point";

  TextFile                         file_;
  std::set<long>                   points_;
  std::map<long, long>             through_; ///< ranges of scalar points, the last by the first
  std::map<std::string, Collected> collected_;
};

void write_field(std::ostream &out, const std::string &text)
{
  out << text << std::string(16 - std::min<std::size_t>(text.size(), 16), ' ');
}

/// The value with ten digits, which fit in 16 columns.
std::string value_text(double x)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.9E", x);
  if (std::string(text).size() > 16) // an exponent of three digits
    std::snprintf(text, sizeof text, "%.8E", x);
  return text;
}

void write_points(std::ostream &out, const std::vector<RowLabel> &rows, const NodePlaces &places)
{
  for (const auto &[node, x] : places)
  {
    out << "GRID*   ";
    for (const std::string &text : {std::to_string(node), std::string("0"), value_text(x[0]), value_text(x[1])})
      write_field(out, text);
    out << "\n*       ";
    write_field(out, value_text(x[2]));
    write_field(out, "0");
    out << '\n';
  }
  for (const RowLabel &row : rows)
    if (row.component == 0)
      out << "SPOINT," << row.node << '\n';
}

void write_matrix(std::ostream &out, const std::string &name, const Eigen::MatrixXd &A,
                  const std::vector<RowLabel> &rows)
{
  const auto card = [&](const std::string &second, const std::string &third, const std::string &fourth)
  {
    out << "DMIG*   ";
    for (const std::string &text : {name, second, third, fourth})
      write_field(out, text);
    out << '\n';
  };
  card("0", "6", "2");
  out << "*       2\n";
  for (Eigen::Index j = 0; j < A.cols(); ++j)
    for (Eigen::Index i = j, first = true; i < A.rows(); ++i)
    {
      if (A(i, j) == 0.)
        continue;
      const RowLabel &column = rows[std::size_t(j)], &row = rows[std::size_t(i)];
      if (first)
        card(std::to_string(column.node), std::to_string(column.component), "");
      first = false;
      out << "*       ";
      for (const std::string &text : {std::to_string(row.node), std::to_string(row.component), value_text(A(i, j))})
        write_field(out, text);
      out << '\n';
    }
}

} // namespace

std::map<std::string, LabelledMatrix> read_dmig(const std::string &file)
{
  return DmigReader(file).read();
}

bool has_dmig(TextFile &file)
{
  BulkCards  cards(file, {"DMIG"});
  const bool has = cards.next();
  file.restart();
  return has;
}

void write_dmig(const std::string &file, const std::map<std::string, Eigen::MatrixXd> &matrices,
                const std::vector<RowLabel> &rows, const NodePlaces &places, const std::string &remark)
{
  AtomicFile    out(file);
  std::ostream &stream = out.stream();
  stream << "$ " << remark << '\n';
  write_points(stream, rows, places);
  for (const auto &[name, A] : matrices)
    write_matrix(stream, name, A, rows);
  out.finish();
}

} // namespace gestell::coupling
