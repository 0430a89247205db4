#include "apps/output/report/section.h"

#include "apps/output/values/result.h"

#include <algorithm>

namespace gestell::apps
{
namespace
{

struct PartHtml
{
  Pictures &pictures;

  std::string operator()(const Section::Sentences &part) const
  {
    return (part.soft ? "<p class=\"soft\">" : "<p>") + escape_xml(part.text) + "</p>\n";
  }
  std::string operator()(const HtmlTable &table) const { return table.is_empty() ? "" : table.html(); }
  std::string operator()(const Section::Drawing &part) const
  {
    pictures.emplace_back(part.name, chart_svg(part.chart));
    const std::string &svg = pictures.back().second;
    return part.shown == Section::Drawing::Shown::live    ? live_figure(part.chart, svg, part.link)
           : part.shown == Section::Drawing::Shown::named ? live_figure_of_file(part.chart, svg, part.name, part.link)
                                                          : figure(svg);
  }
  std::string operator()(const Section::PageTable &part) const { return (*this)(part.table); }
  std::string operator()(const Section::Picture &part) const
  {
    pictures.push_back(part);
    return figure(part.second);
  }
};

bool is_drawn(const Section::Part &part)
{
  return std::holds_alternative<Section::Drawing>(part) || std::holds_alternative<Section::Picture>(part);
}

/// A picture that leaves room for another one beside it.
bool is_narrow(const Section::Part &part)
{
  constexpr double half_a_page = 528.; // of 66 rem
  const auto      *drawing     = std::get_if<Section::Drawing>(&part);
  return drawing && drawing->shown == Section::Drawing::Shown::picture && drawing->chart.width <= half_a_page;
}

struct PartText
{
  std::string operator()(const Section::Sentences &part) const { return part.page ? "" : part.text + '\n'; }
  std::string operator()(const HtmlTable &table) const { return table.is_empty() ? "" : table.terminal(); }
  template <class Drawn>
  std::string operator()(const Drawn &) const
  {
    return "";
  }
};

std::string section_text(const Section &of)
{
  std::string text;
  for (const Section::Part &part : of.parts)
    text += of.page ? "" : std::visit(PartText{}, part);
  return text.empty() ? "" : of.title + '\n' + text;
}

} // namespace

std::string section_html(const Section &of, Pictures &pictures)
{
  std::size_t open = open_figures;
  std::string html;
  for (auto part = of.parts.begin(); part != of.parts.end();)
  {
    if (!is_drawn(*part))
    {
      html += std::visit(PartHtml{pictures}, *part++);
      continue;
    }
    std::vector<std::string> figures;
    for (const auto end = std::find_if_not(part, of.parts.end(), is_drawn); part != end;)
    {
      const auto  row_end = std::max(part + 1, std::find_if_not(part, end, is_narrow));
      const bool  row     = row_end - part > 1;
      std::string drawn;
      while (part != row_end)
        drawn += std::visit(PartHtml{pictures}, *part++);
      figures.push_back(row ? "<div class=\"row\">" + drawn + "</div>\n" : drawn);
    }
    html += first_figures(figures, open);
    open -= std::min(open, figures.size());
  }
  return section(of.id, escape_xml(of.title), html, of.page ? Shown::folded : Shown::open);
}

std::string answers_text(const Result &result)
{
  std::string text;
  for (const auto &answer : result.answers)
    for (const Section &section : answer->sections(result))
      text += section_text(section);
  return text;
}

} // namespace gestell::apps
