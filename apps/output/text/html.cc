#include "apps/output/text/html.h"

#include "apps/output/text/report_style.h"
#include "apps/output/text/svg.h"

namespace gestell::apps
{

std::string section(const std::string &id, const std::string &title, const std::string &content)
{
  return content.empty() ? "" : "<section id=\"" + id + "\"><h2>" + title + "</h2>\n" + content + "</section>\n";
}

std::string figure(const std::string &svg, const std::string &caption)
{
  return "<figure>" + svg + (caption.empty() ? "" : "<figcaption>" + caption + "</figcaption>") + "</figure>\n";
}

std::string note_box(const std::vector<std::string> &notes, const std::string &heading)
{
  if (notes.empty())
    return "";
  std::string html = "<div class=\"warnings\" role=\"note\">";
  if (!heading.empty())
    html += "<strong>" + heading + "</strong>";
  html += "<ul>";
  for (const std::string &note : notes)
    html += "<li>" + escape_xml(note) + "</li>";
  return html + "</ul></div>\n";
}

std::string page_html(const Page &page)
{
  const std::string title = escape_xml(page.title);
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head><meta charset=\"utf-8\"><meta name=\"viewport\" "
         "content=\"width=device-width, initial-scale=1\"><title>" +
         title + "</title><style>" + report_style + page.more_style + "</style></head>\n<body>\n<header><h1>" + title +
         "</h1>\n" + (page.lead.empty() ? "" : "<p class=\"lead\">" + escape_xml(page.lead) + "</p>\n") +
         "</header>\n" + page.body + "<footer>" + page.footer + "</footer>\n" + page.scripts + "</body>\n</html>\n";
}

HtmlTable::HtmlTable(const std::vector<std::string> &titles)
{
  for (const std::string &title : titles)
  {
    is_number_.push_back(title.rfind('#', 0) == 0);
    head_ += is_number_.back() ? "<th class=\"n\">" + title.substr(1) + "</th>" : "<th>" + title + "</th>";
  }
}

void HtmlTable::add(const std::vector<Cell> &row)
{
  rows_ += "<tr>";
  for (std::size_t i = 0; i < row.size(); ++i)
  {
    const std::string kind = std::string(is_number_[i] ? "n" : "") + (row[i].stands_out ? " peak" : "");
    const std::string text = escape_xml(row[i].text);
    rows_ += (kind.empty() ? "<td>" : "<td class=\"" + kind + "\">") +
             (row[i].link.empty() ? text : "<a href=\"" + escape_xml(row[i].link) + "\">" + text + "</a>") + "</td>";
  }
  rows_ += "</tr>\n";
}

void HtmlTable::add_note(const std::string &text)
{
  rows_ += "<tr><td class=\"soft\" colspan=\"" + std::to_string(is_number_.size()) + "\">" + escape_xml(text) +
           "</td></tr>\n";
}

std::string HtmlTable::in_box(const std::string &kind) const
{
  constexpr std::size_t few = 9; // columns that fit a printed page in letters of the usual size
  return "<div class=\"" + kind + (is_number_.size() > few ? " many" : "") + "\"><table><thead><tr>" + head_ +
         "</tr></thead>\n<tbody>" + rows_ + "</tbody></table></div>\n";
}

std::string inside_script(std::string json)
{
  for (std::size_t at = json.find('<'); at != std::string::npos; at = json.find('<', at))
    json.replace(at, 1, "\\u003c");
  return json;
}

HtmlTable::Cell peak(HtmlTable::Cell cell, bool condition)
{
  cell.stands_out = condition;
  return cell;
}

} // namespace gestell::apps
