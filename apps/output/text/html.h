#pragma once

#include <string>
#include <vector>

namespace gestell::apps
{

/// Pieces of a page; texts are HTML already.
std::string section(const std::string &id, const std::string &title, const std::string &content); ///< "" if empty
std::string figure(const std::string &svg, const std::string &caption = "");

/// Notes as a box that is seen; "" if there are none.  They are escaped.
std::string note_box(const std::vector<std::string> &notes, const std::string &heading = "");

/// A page of its own, without references to anything outside it; title and lead are escaped.
struct Page
{
  std::string title, lead; ///< the lead stands below the title; empty: none
  std::string body, footer;
  std::string more_style{}; ///< beside that of all pages
  std::string scripts{};    ///< elements at its end
};
std::string page_html(const Page &page);

/// JSON as it may stand within a script element, whatever names it holds.
std::string inside_script(std::string json);

/// A table to be read; its cells are escaped.
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

  /// @param titles  of the columns, in HTML; "#f [Hz]": of one with numbers
  explicit HtmlTable(const std::vector<std::string> &titles);

  void add(const std::vector<Cell> &row);
  void add_note(const std::string &text); ///< a row over all columns
  bool is_empty() const { return rows_.empty(); }

  std::string html() const { return in_box("wide"); }            ///< scrolled sideways where it is too wide
  std::string scrolled_html() const { return in_box("scroll"); } ///< in a box that long tables are scrolled in
  std::string terminal() const;                                  ///< the same in columns

private:
  std::string in_box(const std::string &kind) const;

  std::vector<bool>              is_number_; ///< by column
  std::vector<std::string>       heads_;
  std::vector<std::vector<Cell>> rows_; ///< a single cell of several columns: a note
};

/// A cell that stands out where `condition` holds.
HtmlTable::Cell peak(HtmlTable::Cell cell, bool condition = true);

} // namespace gestell::apps
