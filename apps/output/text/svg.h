#pragma once

#include <string>
#include <utility>
#include <vector>

namespace gestell::apps
{

using Pictures = std::vector<std::pair<std::string, std::string>>; ///< file name without extension, SVG

/// Escaped text for XML and HTML, for elements and quoted attributes.
std::string escape_xml(const std::string &text);

/// Appends a coordinate of a picture with at most one digit after the point.
void        append_coordinate(std::string &svg, double x);
std::string coordinate(double x);

/// Opening element of a picture of width x height units: name space, title for screen readers, style, background.  Its
/// colours follow the reader's choice of light or dark and print on white; the classes s0..s6 are the colour-blind safe
/// colours of lines (Okabe & Ito), f0..f6 those of areas, d1..d5 the dash patterns.
std::string svg_head(double width, double height, const std::string &title);

/// Text at (x, y), or "" for an empty text; `anchor` is start, middle or end; `style` is a class of the style sheet:
/// "title", "tick", "label".
std::string svg_text(double x, double y, const std::string &text, const std::string &style,
                     const std::string &anchor = "start", double turn_degrees = 0.);

/// A straight line; `style` contains classes of the style sheet.
std::string svg_line(const std::string &style, double x0, double y0, double x1, double y1);

/// Attributes of a rectangle: x="" y="" width="" height="", with a blank before them.
std::string svg_box(double x, double y, double width, double height);

/// A shape with a tooltip.
std::string svg_hint(const std::string &text, const std::string &shape);

constexpr int n_series_colours = 7; ///< distinguishable on light and on dark background

} // namespace gestell::apps
