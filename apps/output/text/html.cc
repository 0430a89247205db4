#include "apps/output/text/html.h"

#include "fem/values/number_text.h"

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

std::string cell(const std::string &text, const char *kind)
{
  return (*kind != '\0' ? std::string("<td class=\"") + kind + "\">" : std::string("<td>")) + text + "</td>";
}

std::string number_cell(double x, int digits)
{
  return cell(short_text(x, digits), "n");
}

} // namespace gestell::apps
