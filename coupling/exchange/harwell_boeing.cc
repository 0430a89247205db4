#include "coupling/exchange/harwell_boeing.h"

#include "coupling/exchange/text_file.h"

#include <algorithm>
#include <optional>
#include <regex>

namespace gestell::coupling
{

namespace
{

/// A format such as (8I10) or (1P,3D25.16): numbers in columns of fixed width.
struct FortranFormat
{
  std::size_t width;
};

std::optional<FortranFormat> format_of(std::string_view text)
{
  static const std::regex form("\\(\\s*(?:[0-9]+P\\s*,?)?\\s*[0-9]*\\s*[IEDFG]\\s*([0-9]+)[0-9.EeDd]*\\s*\\)",
                               std::regex::icase);
  std::match_results<std::string_view::const_iterator> found;
  if (!std::regex_search(text.begin(), text.end(), found, form))
    return {};
  const std::size_t width = std::size_t(std::stoul(found[1].str()));
  return width > 0 && width < 60 ? std::optional(FortranFormat{width}) : std::nullopt;
}

std::string_view columns(std::string_view line, std::size_t from, std::size_t count)
{
  return from < line.size() ? line.substr(from, count) : std::string_view();
}

bool is_type(std::string_view word)
{
  return word.size() == 3 && capitals(word).find_first_not_of("RCPSUHZEA") == std::string::npos &&
         std::string("RCP").find(capitals(word)[0]) != std::string::npos &&
         std::string("AE").find(capitals(word)[2]) != std::string::npos;
}

/// Reads numbers in columns, over as many lines as necessary.
class Columns
{
public:
  Columns(TextFile &file, FortranFormat format, long count, const char *what)
      : file_(file), width_(format.width), left_(count), what_(what)
  {
  }

  std::string_view next()
  {
    while (at_ >= line_.size() || trimmed(line_.substr(at_)).empty())
    {
      if (!file_.next())
        file_.fail_at_end(std::to_string(left_) + " " + what_ + " are still announced; it is truncated");
      line_ = file_.line();
      at_   = 0;
    }
    const std::string_view field = line_.substr(at_, width_);
    at_ += width_;
    --left_;
    return field;
  }

private:
  TextFile        &file_;
  std::size_t      width_;
  long             left_;
  const char      *what_;
  std::string_view line_;
  std::size_t      at_ = 0;
};

struct Head
{
  std::string   type;
  long          rows = 0, entries = 0;
  FortranFormat pointers{}, indices{}, values{};
};

class HarwellBoeingReader
{
public:
  explicit HarwellBoeingReader(const std::string &name) : file_(name) {}

  LabelledMatrix read()
  {
    const Head        head = read_head();
    std::vector<long> first;
    Columns           pointers(file_, head.pointers, head.rows + 1, "pointers to columns");
    for (long j = 0; j <= head.rows; ++j)
      first.push_back(file_.whole(pointers.next(), "a pointer to a column"));
    require_ascending(first, head.entries);
    std::vector<FileEntry> entries(static_cast<std::size_t>(head.entries));
    Columns                indices(file_, head.indices, head.entries, "numbers of rows");
    for (long j = 0; j < head.rows; ++j)
      for (long k = first[std::size_t(j)]; k < first[std::size_t(j) + 1]; ++k)
        entries[std::size_t(k - 1)] = {row(indices.next(), head.rows), int(j), 0., file_.number()};
    Columns values(file_, head.values, head.entries, "values");
    for (FileEntry &entry : entries)
      entry.value = file_.real(values.next(), "a value");
    const Triangles triangles = head.type[1] == 'S' ? triangles_of(entries) : Triangles::both;
    return {assembled(file_, std::move(entries), int(head.rows), triangles, {})};
  }

private:
  void line(const char *what)
  {
    if (!file_.next())
      file_.fail_at_end(std::string(what) + " are missing");
  }

  Head read_head()
  {
    line("title and key");
    line("numbers of lines");
    const auto counts         = words_of(file_.line());
    const bool has_right_side = counts.size() > 4 && file_.whole(counts[4], "the number of lines") > 0;
    line("type and sizes");
    const auto words = words_of(file_.line());
    if (words.size() < 4 || !is_type(words[0]))
      file_.fail("expected type, rows, columns and entries, such as RSA 120 120 1500");
    Head head;
    head.type          = capitals(words[0]);
    head.rows          = file_.whole(words[1], "the number of rows");
    const long columns = file_.whole(words[2], "the number of columns");
    head.entries       = file_.whole(words[3], "the number of entries");
    require_kind(head.type);
    if (head.rows != columns)
      file_.fail("a matrix of " + std::to_string(head.rows) + " x " + std::to_string(columns) +
                 " is not square; mass, damping and stiffness are");
    if (const long most = long(file_.size());
        head.rows < 1 || head.entries < 1 || head.rows > most || head.entries > most / 2)
      file_.fail(std::to_string(head.rows) + " rows with " + std::to_string(head.entries) +
                 " entries do not fit in a file of " + std::to_string(most) +
                 " bytes; the file is truncated, or its header is wrong");
    line("formats");
    const std::string_view text(file_.line());
    const auto             pointers = format_of(gestell::coupling::columns(text, 0, 16)),
               indices              = format_of(gestell::coupling::columns(text, 16, 16)),
               values               = format_of(gestell::coupling::columns(text, 32, 20));
    if (!pointers || !indices || !values)
      file_.fail("expected the formats of pointers, rows and values, such as (8I10) (8I10) (4E20.12)");
    head.pointers = *pointers;
    head.indices  = *indices;
    head.values   = *values;
    if (has_right_side)
      line("formats of the right-hand side");
    return head;
  }

  void require_kind(const std::string &type) const
  {
    if (type[0] == 'C')
      file_.fail(
          "the matrix is complex; real matrices are needed. Write stiffness, mass and damping separately: HBMAT with "
          "STIFF, MASS and DAMP");
    if (type[0] == 'P')
      file_.fail("the file contains a pattern without values; write the matrix itself");
    if (type[2] == 'E')
      file_.fail("the file contains element matrices; write the assembled matrix (type RSA or RUA)");
    if (type[1] != 'S' && type[1] != 'U')
      file_.fail("'" + type + "' is not a symmetric matrix; RSA and RUA are read");
  }

  void require_ascending(const std::vector<long> &first, long entries) const
  {
    if (first.front() != 1 || first.back() != entries + 1 || !std::is_sorted(first.begin(), first.end()))
      file_.fail("the pointers to columns must increase from 1 to " + std::to_string(entries + 1) +
                 ", one more than entries");
  }

  int row(std::string_view field, long rows) const
  {
    const long i = file_.whole(field, "the number of a row");
    if (i < 1 || i > rows)
      file_.fail("there is no row " + std::to_string(i) + "; rows are from 1 to " + std::to_string(rows));
    return int(i - 1);
  }

  /// Some releases of Ansys write both triangles of superelements and call them RSA.
  static Triangles triangles_of(const std::vector<FileEntry> &entries)
  {
    bool below = false, above = false;
    for (const FileEntry &entry : entries)
      (entry.row > entry.column ? below : above) |= entry.row != entry.column;
    return below && above ? Triangles::both : Triangles::one;
  }

  TextFile file_;
};

} // namespace

LabelledMatrix read_harwell_boeing(const std::string &file)
{
  return HarwellBoeingReader(file).read();
}

bool is_harwell_boeing(TextFile &file)
{
  file.restart();
  const bool there = file.next() && file.next() && file.next();
  const auto words = there ? words_of(file.line()) : std::vector<std::string_view>{};
  const bool is    = words.size() >= 4 && is_type(words[0]);
  file.restart();
  return is;
}

} // namespace gestell::coupling
