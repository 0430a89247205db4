#pragma once

#include <string>
#include <vector>

namespace gestell::apps
{

enum class Shown
{
  open,
  folded ///< only its title, until the reader opens it; printed in full
};

/// Parts of a page; their texts are HTML already.
std::string section(const std::string &id, const std::string &title, const std::string &content,
                    Shown shown = Shown::open); ///< "" if empty
std::string figure(const std::string &svg, const std::string &caption = "");
std::string folded(const std::string &title, const std::string &content); ///< "" if empty

constexpr std::size_t open_figures = 2; ///< of a section: charts that fill a screen
/// Figures one below the other, of which all but the first are folded.
std::string first_figures(const std::vector<std::string> &figures, std::size_t shown = open_figures);

/// Notes in a highlighted box, a line each until it is opened; "" if there are none.  Their text is escaped.
std::string note_box(const std::vector<std::string> &notes, const std::string &heading = "");

/// A number that a page begins with.
struct KeyNumber
{
  std::string value, meaning;
};

/// What a page begins with: its answer in a sentence and a few numbers; escaped.
struct Headline
{
  std::string            sentence{};
  std::vector<KeyNumber> numbers{};

  std::string html() const; ///< "" if empty
};

/// A stand-alone page without external references; title and lead are escaped.
struct Page
{
  std::string title, lead; ///< the lead is printed below the title; empty: none
  std::string body, footer;
  std::string more_style{}; ///< in addition to the style of all pages
  std::string scripts{};    ///< elements at the end of the page
};
std::string page_html(const Page &page);

/// JSON that is safe inside a script element, whatever names it contains.
std::string inside_script(std::string json);

/// A table for people; its cells are escaped.
class HtmlTable
{
public:
  struct Cell
  {
    Cell(const std::string &text) : text(text) {} ///< implicit: most cells are text
    Cell(const char *text) : text(text) {}

    std::string text;
    bool        stands_out = false;
    std::string link{}; ///< relative to the page; empty: none
  };

  /// @param titles  of the columns, in HTML; "#f [Hz]": a column of numbers
  explicit HtmlTable(const std::vector<std::string> &titles);

  void add(const std::vector<Cell> &row);
  void add_note(const std::string &text); ///< a row over all columns
  bool is_empty() const { return rows_.empty(); }

  std::string html() const; ///< in a box that scrolls sideways if necessary, a long one also down
  std::string scrolled_html() const { return in_box("scroll"); } ///< in a box that scrolls long tables
  std::string terminal() const;                                  ///< the table as text in columns

private:
  std::string in_box(const std::string &kind) const;

  std::vector<bool>              is_number_; ///< by column
  std::vector<std::string>       heads_;
  std::vector<std::vector<Cell>> rows_; ///< a single cell of several columns: a note
};

/// A cell that is highlighted if `condition` is true.
HtmlTable::Cell peak(HtmlTable::Cell cell, bool condition = true);

} // namespace gestell::apps
