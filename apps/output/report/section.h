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

/// What is read of an answer: sentences, tables and charts in their order.  A terminal has no charts.
struct Section
{
  enum class Place ///< among those of the report
  {
    first,
    course,     ///< before the other results: what the run went through
    results,    ///< behind the peaks
    history,    ///< behind the charts over time
    frequencies ///< before the modes
  };
  struct Sentences
  {
    std::string text;         ///< not escaped
    bool        page = false; ///< of its charts: for the page alone
    bool        soft = false;
  };
  struct Drawing
  {
    std::string name; ///< of its file, without ending
    Chart       chart;
    ChartLink   link = ChartLink::none;
    enum class Shown
    {
      live, ///< to zoom and read
      picture,
      named ///< live, without a copy for paper, where a line names its file
    } shown = Shown::live;
  };
  using Picture = Pictures::value_type;
  struct PageTable ///< not for a terminal
  {
    HtmlTable table;
  };
  using Part = std::variant<Sentences, HtmlTable, PageTable, Drawing, Picture>;

  std::string       id, title, link; ///< link: its name in the contents of the page
  Place             place = Place::results;
  bool              page  = false; ///< for the page alone
  std::vector<Part> parts{};
};

/// As a piece of a page, with its pictures; "" without parts.
std::string section_html(const Section &section, Pictures &pictures);

/// For a terminal, of all answers: titles, sentences and tables.
std::string answers_text(const Result &result);

} // namespace gestell::apps
