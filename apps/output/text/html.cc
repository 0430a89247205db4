#include "apps/output/text/html.h"

#include "apps/output/text/page_language.h"
#include "apps/output/text/svg.h"
#include "fem/values/number_text.h"

#include <algorithm>

namespace gestell::apps
{
namespace
{

/// Style sheet of the report: light or dark as the reader has chosen, white on paper.
const char *const report_style = R"css(
:root { --paper: #ffffff; --ink: #22272e; --soft: #5b6570; --rule: #d9dee4; --band: #f5f7f9;
        --warn: #8a4b00; --warn-band: #fff4e0; --warn-rule: #e0a030; }
@media screen and (prefers-color-scheme: dark) {
  :root { --paper: #16191d; --ink: #d8dde3; --soft: #98a2ad; --rule: #333a42; --band: #1d2126;
          --warn: #ffce85; --warn-band: #2b2213; --warn-rule: #8a6420; }
}
* { box-sizing: border-box; }
html { color-scheme: light dark; }
body { margin: 0 auto; padding: 2.2rem 1.6rem 4rem; max-width: 66rem; overflow-wrap: break-word; background: var(--paper); color: var(--ink);
       font: 16px/1.55 system-ui, "Helvetica Neue", Arial, "DejaVu Sans", sans-serif; }
h1 { font-size: 1.9rem; line-height: 1.2; margin: 0 0 .3rem; }
h2 { font-size: 1.25rem; margin: 2.4rem 0 .6rem; padding-top: .7rem; border-top: 1px solid var(--rule); }
h3 { font-size: 1rem; margin: 1.4rem 0 .4rem; }
p { margin: .5rem 0; max-width: 44rem; }
.soft { color: var(--soft); }
.lead { font-size: 1.08rem; }
nav { margin: 1rem 0 0; font-size: .92rem; }
nav a { color: inherit; margin-right: 1.1rem; }
.warnings { margin: 1.3rem 0; padding: .7rem 1.1rem; background: var(--warn-band); border-left: 4px solid var(--warn-rule);
            color: var(--warn); }
.warnings ul { margin: .2rem 0; padding-left: 1.2rem; }
.warnings li.long { list-style: none; margin-left: -1.2rem; }
summary { cursor: pointer; }
summary > h2 { display: inline-block; margin: 0; padding: 0; border: 0; }
section > details:only-child { margin-top: .9rem; padding-top: .7rem; border-top: 1px solid var(--rule); }
section > details:only-child[open] { margin-top: 2.2rem; }
section > details[open] > summary { margin-bottom: .6rem; }
details.line:not([open]) > summary { white-space: nowrap; overflow: hidden; text-overflow: ellipsis; }
table { border-collapse: collapse; margin: .7rem 0 1.1rem; font-variant-numeric: tabular-nums; font-size: .94rem; }
th, td { padding: .26rem .9rem .26rem 0; text-align: left; border-bottom: 1px solid var(--rule); vertical-align: top; }
th { font-weight: 600; color: var(--soft); white-space: nowrap; }
.n { text-align: right; white-space: nowrap; }
td.peak { font-weight: 600; }
.scroll { overflow: auto; max-height: 26rem; border: 1px solid var(--rule); padding: 0 .9rem; display: inline-block;
          max-width: 100%; }
.wide { overflow-x: auto; }
.wide th, .scroll th { white-space: normal; vertical-align: bottom; }
.wide td:first-child, .scroll td:first-child { white-space: nowrap; }
.keys { display: flex; flex-wrap: wrap; gap: .6rem 2.2rem; margin: .9rem 0; }
.keys strong { display: block; font-size: 1.25rem; font-variant-numeric: tabular-nums; }
.keys span { color: var(--soft); font-size: .88rem; }
figure { margin: .9rem 0 1.5rem; }
figure svg { max-width: 100%; height: auto; display: block; }
figcaption { color: var(--soft); font-size: .88rem; max-width: 44rem; }
.row { display: flex; flex-wrap: wrap; gap: 1.2rem 1.6rem; align-items: flex-start; }
.row figure { margin: 0; flex: 1 1 17rem; }
.row > * { min-width: 0; max-width: 100%; }
.modes { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(15rem, 100%), 1fr)); gap: 1rem; }
.modes figure { margin: 0; min-width: 0; }
.bars { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(24rem, 100%), 1fr)); gap: 1rem; }
.bars figure { margin: 0; min-width: 0; }
pre { background: var(--band); padding: .8rem 1rem; overflow-x: auto; font-size: .86rem; line-height: 1.45; }
footer { margin-top: 3rem; padding-top: .7rem; border-top: 1px solid var(--rule); color: var(--soft); font-size: .88rem; }
@media screen and (max-width: 40rem) {
  body { padding: 1.2rem .8rem 3rem; }
  h1 { font-size: 1.5rem; }
  th, td { padding-right: .6rem; }
  figure { overflow-x: auto; }
  figure svg { max-width: none; }
}
@media print {
  @page { size: A4; margin: 16mm 14mm; }
  body { max-width: none; padding: 0; font-size: 10pt; }
  nav { display: none; }
  h2 { margin-top: 1.4rem; }
  .scroll, .wide { max-height: none; overflow: visible; border: 0; padding: 0; display: block; }
  table { font-size: 8.5pt; max-width: 100%; }
  th, td { padding-right: .5rem; }
  .many table { font-size: 6.6pt; }
  .many th, .many td { padding-right: .3rem; }
  th, th.n { white-space: normal; }
  #view { display: none; }
  pre { white-space: pre-wrap; overflow: visible; font-size: 8pt; }
  details.line:not([open]) > summary { white-space: normal; }
  figure, tr, .keys, .warnings, h2 + p, h3 + p { break-inside: avoid; }
  .long { columns: 2; column-gap: 1.5rem; }
  h1, h2, h3, h2 + p, h3 + p { break-after: avoid; }
  .modes { grid-template-columns: repeat(3, 1fr); }
  .bars { grid-template-columns: repeat(2, 1fr); }
}
)css";

/// Folds the last sections of a page of more than eight screens of 1080 pixels; opens what a link leads to, and all for
/// print.
const char *const fold_script = R"js(<script>
(function () {
  const shorten = () => {
    const open = [...document.querySelectorAll('section > details:only-child[open]')].reverse();
    for (const section of open) if (document.documentElement.scrollHeight > 8 * 1080) section.open = false;
  };
  const reveal = (hash) => {
    const target = hash.length > 1 && document.getElementById(decodeURIComponent(hash.slice(1)));
    if (!target) return;
    for (let e = target.querySelector(':scope > details') || target; e; e = e.parentElement) if (e.tagName === 'DETAILS') e.open = true;
    target.scrollIntoView();
  };
  addEventListener('click', (event) => {
    const link = event.target.closest('a[href^="#"]');
    if (link) setTimeout(() => reveal(link.hash));
  });
  addEventListener('load', () => setTimeout(() => { shorten(); reveal(location.hash); })); // behind what is drawn there
  let closed = [];
  const open = (is) => closed.forEach((e) => { e.open = is; });
  addEventListener('beforeprint', () => { closed = [...document.querySelectorAll('details:not([open])')]; open(true); });
  addEventListener('afterprint', () => open(false));
})();
</script>
)js";

/// A note as it stands where it fits into a line of the page, else with the rest on demand.
std::string note_html(const std::string &note)
{
  constexpr std::size_t letters_of_a_line = 110; // in a box of 64 rem
  return n_letters(note) > letters_of_a_line
             ? "<li class=\"long\"><details class=\"line\"><summary>" + escape_xml(note) + "</summary></details></li>"
             : "<li>" + escape_xml(note) + "</li>";
}

/// A part that a reader can fold and open.
std::string details(const std::string &title, const std::string &content, Shown shown)
{
  return std::string("<details") + (shown == Shown::open ? " open" : "") + "><summary>" + title + "</summary>\n" +
         content + "</details>\n";
}

} // namespace

std::string section(const std::string &id, const std::string &title, const std::string &content, Shown shown)
{
  return content.empty()
             ? ""
             : "<section id=\"" + id + "\">" + details("<h2>" + title + "</h2>", content, shown) + "</section>\n";
}

std::string folded(const std::string &title, const std::string &content)
{
  return content.empty() ? "" : details(title, content, Shown::folded);
}

std::string figure(const std::string &svg, const std::string &caption)
{
  return "<figure>" + svg + (caption.empty() ? "" : "<figcaption>" + caption + "</figcaption>") + "</figure>\n";
}

std::string first_figures(const std::vector<std::string> &figures, std::size_t shown)
{
  std::string first, others;
  for (std::size_t i = 0; i < figures.size(); ++i)
    (i < shown ? first : others) += figures[i];
  return first + folded(count_text(figures.size() - std::min(shown, figures.size()), "more chart"), others);
}

std::string note_box(const std::vector<std::string> &notes, const std::string &heading)
{
  if (notes.empty())
    return "";
  std::string html = "<div class=\"warnings\" role=\"note\">";
  if (!heading.empty())
    html += "<strong>" + heading + "</strong>";
  constexpr std::size_t most_notes = 8; // a quarter of a screen; the others are folded
  std::string           first, others;
  for (std::size_t i = 0; i < notes.size(); ++i)
    (i < most_notes ? first : others) += note_html(notes[i]);
  html += "<ul>" + first + "</ul>";
  if (!others.empty())
    html += folded(std::to_string(notes.size() - most_notes) + " more", "<ul>" + others + "</ul>");
  return html + "</div>\n";
}

std::string Headline::html() const
{
  std::string keys;
  for (const auto &[value, meaning] : numbers)
    keys += "<div><strong>" + escape_xml(value) + "</strong><span>" + escape_xml(meaning) + "</span></div>";
  return (sentence.empty() ? "" : "<p id=\"computed\">" + escape_xml(sentence) + "</p>\n") +
         (keys.empty() ? "" : "<div class=\"keys\">" + keys + "</div>\n");
}

std::string page_html(const Page &page)
{
  const std::string title = escape_xml(page.title);
  return in_page_language("<!DOCTYPE html>\n<html lang=\"en\">\n<head><meta charset=\"utf-8\"><meta name=\"viewport\" "
         "content=\"width=device-width, initial-scale=1\"><title>" +
         title + "</title><style>" + report_style + page.more_style + "</style></head>\n<body>\n<header><h1>" + title +
         "</h1>\n" + (page.lead.empty() ? "" : "<p class=\"lead\">" + escape_xml(page.lead) + "</p>\n") +
         "</header>\n" + page.body + "<footer>" + page.footer + "</footer>\n" + page.scripts +
         (page.body.find("<details") != std::string::npos ? fold_script : "") + "</body>\n</html>\n");
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

std::string HtmlTable::html() const
{
  constexpr std::size_t rows_of_a_screen = 30; // largest table without scrolling: 900 pixels, a screen
  return in_box(rows_.size() > rows_of_a_screen ? "scroll" : "wide");
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
