#pragma once

#include "apps/output/interactive/live_chart.h"
#include "apps/output/text/html.h"
#include "apps/output/text/svg.h"

#include <string>
#include <variant>
#include <vector>

namespace gestell::apps
{

struct Result;

/// Part of an answer for people: sentences, tables and charts in their order.  A terminal shows no charts.
struct Section
{
  enum class Place ///< position among the sections of the report
  {
    first,
    course,     ///< before the other results: the events of the run
    results,    ///< after the peaks
    history,    ///< after the charts over time
    frequencies ///< before the modes
  };
  struct Sentences
  {
    std::string text;         ///< not escaped
    bool        page = false; ///< only for the page: the text refers to its charts
    bool        soft = false;
  };
  struct Drawing
  {
    std::string name; ///< name of its file, without extension
    Chart       chart;
    ChartLink   link = ChartLink::none;
    enum class Shown
    {
      live, ///< interactive
      picture,
      named ///< interactive, without a copy for print, where a line names the file
    } shown = Shown::live;
  };
  using Picture = Pictures::value_type;
  struct PageTable ///< not for a terminal
  {
    HtmlTable table;
  };
  using Part = std::variant<Sentences, HtmlTable, PageTable, Drawing, Picture>;

  std::string       id, title, link; ///< link: its name in the table of contents
  Place             place = Place::results;
  bool              page  = false; ///< only for the page, where it is folded: nobody asked for it
  std::vector<Part> parts{};
};

/// HTML of the section, with its pictures; "" if it has no parts.
std::string section_html(const Section &section, Pictures &pictures);

/// Text of all answers for a terminal: titles, sentences and tables.
std::string answers_text(const Result &result);

} // namespace gestell::apps
