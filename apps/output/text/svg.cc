#include "apps/output/text/svg.h"

#include <array>
#include <cmath>

namespace gestell::apps
{
namespace
{

/// After the colour-blind safe set of Okabe & Ito, darker on white and lighter on black.
const std::array<const char *, n_series_colours> on_light = {"#0072b2", "#d55e00", "#009e73", "#b0508f",
                                                             "#b07a00", "#3a3f45", "#3f9fd6"};
const std::array<const char *, n_series_colours> on_dark  = {"#4fb0ea", "#ff8a3d", "#2fc79b", "#e58cc3",
                                                             "#f0b429", "#d5d9de", "#8fd0f5"};

std::string colours(const std::array<const char *, n_series_colours> &series, const std::string &paper,
                    const std::string &ink, const std::string &grid)
{
  std::string css = ".gst{--paper:" + paper + ";--ink:" + ink + ";--grid:" + grid + ";";
  for (int i = 0; i < n_series_colours; ++i)
    css += "--s" + std::to_string(i) + ":" + series[i] + ";";
  return css + "}";
}

std::string style_sheet()
{
  std::string css = colours(on_light, "#ffffff", "#22272e", "#dfe3e8") +
                    "@media screen and (prefers-color-scheme:dark){" +
                    colours(on_dark, "#16191d", "#d8dde3", "#333a42") +
                    "}"
                    ".gst{font-family:system-ui,'Helvetica Neue',Arial,'DejaVu Sans',sans-serif;font-size:12px}"
                    ".gst text{fill:var(--ink)}.gst .title{font-size:14px;font-weight:600}"
                    ".gst .small{font-size:10.5px;opacity:.75}"
                    ".gst .paper{fill:var(--paper)}.gst .grid{stroke:var(--grid);stroke-width:1;fill:none}"
                    ".gst .axis{stroke:var(--ink);stroke-width:1;fill:none}"
                    ".gst .zero{stroke:var(--ink);stroke-width:.8;opacity:.55;fill:none}"
                    ".gst .event{stroke:var(--ink);stroke-width:.8;stroke-dasharray:2 3;opacity:.45;fill:none}"
                    ".gst .outline{stroke:var(--ink);stroke-width:.6;opacity:.3;fill:none}"
                    ".gst .line{fill:none;stroke-width:1.4;stroke-linejoin:round;stroke-linecap:round}"
                    ".gst .d1{stroke-dasharray:7 3}.gst .d2{stroke-dasharray:2 3}.gst .d3{stroke-dasharray:9 3 2 3}"
                    ".gst .d4{stroke-dasharray:4 2}.gst .d5{stroke-dasharray:12 4 2 4 2 4}";
  for (int i = 0; i < n_series_colours; ++i)
  {
    const std::string n = std::to_string(i);
    css += ".gst .s" + n + "{stroke:var(--s" + n + ")}.gst .f" + n + "{fill:var(--s" + n + ")}";
  }
  return css;
}

} // namespace

std::string escape_xml(const std::string &text)
{
  std::string safe;
  for (const char c : text)
    switch (c)
    {
    case '&':
      safe += "&amp;";
      break;
    case '<':
      safe += "&lt;";
      break;
    case '>':
      safe += "&gt;";
      break;
    case '"':
      safe += "&quot;";
      break;
    default:
      // XML 1.0 allows no other control characters, not even escaped.
      if (static_cast<unsigned char>(c) >= 0x20 || c == '\n' || c == '\t')
        safe += c;
    }
  return safe;
}

void append_coordinate(std::string &svg, double x)
{
  const long tenths = std::lround(10. * x), whole = std::labs(tenths) / 10, part = std::labs(tenths) % 10;
  if (tenths < 0)
    svg += '-';
  svg += std::to_string(whole);
  if (part != 0)
    svg += '.' + std::to_string(part);
}

std::string coordinate(double x)
{
  std::string text;
  append_coordinate(text, x);
  return text;
}

std::string svg_head(double width, double height, const std::string &title)
{
  const std::string w = coordinate(width), h = coordinate(height);
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"gst\" role=\"img\" width=\"" + w + "\" height=\"" + h +
         "\" viewBox=\"0 0 " + w + " " + h + "\"><title>" + escape_xml(title) + "</title><style>" + style_sheet() +
         "</style><rect class=\"paper\" width=\"" + w + "\" height=\"" + h + "\"/>\n";
}

std::string svg_text(double x, double y, const std::string &text, const std::string &style, const std::string &anchor,
                     double turn_degrees)
{
  if (text.empty())
    return "";
  const std::string at = turn_degrees != 0. ? "transform=\"translate(" + coordinate(x) + " " + coordinate(y) +
                                                  ") rotate(" + coordinate(turn_degrees) + ")\">"
                                            : "x=\"" + coordinate(x) + "\" y=\"" + coordinate(y) + "\">";
  return "<text class=\"" + style + "\" text-anchor=\"" + anchor + "\" " + at + escape_xml(text) + "</text>\n";
}

std::string svg_line(const std::string &style, double x0, double y0, double x1, double y1)
{
  return "<path class=\"" + style + "\" d=\"M" + coordinate(x0) + " " + coordinate(y0) + "L" + coordinate(x1) + " " +
         coordinate(y1) + "\"/>";
}

std::string svg_box(double x, double y, double width, double height)
{
  return " x=\"" + coordinate(x) + "\" y=\"" + coordinate(y) + "\" width=\"" + coordinate(width) + "\" height=\"" +
         coordinate(height) + "\"";
}

std::string svg_hint(const std::string &text, const std::string &shape)
{
  return "<g><title>" + escape_xml(text) + "</title>" + shape + "</g>\n";
}

} // namespace gestell::apps
