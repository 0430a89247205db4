#include "apps/output/text/html.h"

#include "apps/output/text/report_style.h"
#include "apps/output/text/svg.h"
#include "fem/values/number_text.h"

#include <algorithm>

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
    heads_.push_back(title.substr(is_number_.back() ? 1 : 0));
  }
}

void HtmlTable::add(const std::vector<Cell> &row)
{
  rows_.push_back(row);
}

void HtmlTable::add_note(const std::string &text)
{
  rows_.push_back({text});
}

std::string HtmlTable::in_box(const std::string &kind) const
{
  constexpr std::size_t few  = 9; // columns that fit a printed page in letters of the usual size
  std::string           html = "<div class=\"" + kind + (heads_.size() > few ? " many" : "") + "\"><table><thead><tr>";
  for (std::size_t i = 0; i < heads_.size(); ++i)
    html += (is_number_[i] ? "<th class=\"n\">" : "<th>") + heads_[i] + "</th>";
  html += "</tr></thead>\n<tbody>";
  for (const std::vector<Cell> &row : rows_)
  {
    html += "<tr>";
    if (row.size() < heads_.size())
      html +=
          "<td class=\"soft\" colspan=\"" + std::to_string(heads_.size()) + "\">" + escape_xml(row[0].text) + "</td>";
    else
      for (std::size_t i = 0; i < row.size(); ++i)
      {
        const std::string style = std::string(is_number_[i] ? "n" : "") + (row[i].stands_out ? " peak" : "");
        const std::string text  = escape_xml(row[i].text);
        html += (style.empty() ? "<td>" : "<td class=\"" + style + "\">") +
                (row[i].link.empty() ? text : "<a href=\"" + escape_xml(row[i].link) + "\">" + text + "</a>") + "</td>";
      }
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

std::string HtmlTable::terminal() const
{
  std::vector<std::size_t> widths;
  for (std::size_t j = 0; j < heads_.size(); ++j)
  {
    widths.push_back(n_letters(heads_[j]));
    for (const std::vector<Cell> &row : rows_)
      if (row.size() == heads_.size())
        widths[j] = std::max(widths[j], n_letters(row[j].text));
  }
  std::string text;
  const auto  add = [&](const std::vector<Cell> &row)
  {
    for (std::size_t j = 0; j < row.size(); ++j)
    {
      const std::size_t letters = n_letters(row[j].text);
      const std::string space(row.size() == widths.size() ? widths[j] - letters : 0, ' ');
      text += "  " + (is_number_[j] ? space + row[j].text : row[j].text + space);
    }
    text.erase(text.find_last_not_of(' ') + 1);
    text += '\n';
  };
  add({heads_.begin(), heads_.end()});
  for (const std::vector<Cell> &row : rows_)
    add(row);
  return text;
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
