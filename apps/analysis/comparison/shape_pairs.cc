#include "apps/analysis/comparison/shape_pairs.h"

#include "apps/output/text/svg.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>

namespace gestell::apps
{

namespace
{

/// pixels
constexpr double panel_width = 190., gap = 16., row = 26., bar = 9., top = 66., letter = 6.6, head_room = 46.;

/// Amplitudes of a shape with angles times the arm, largest 1.
Eigen::VectorXd drawn(const ComparedShapes &shapes, const Eigen::VectorXd &shape, double arm)
{
  Eigen::VectorXd y = shape;
  for (Eigen::Index k = 0; k < y.size(); ++k)
    if (shapes.measures[std::size_t(k)].unit == "rad")
      y[k] *= arm;
  const double largest = y.cwiseAbs().maxCoeff();
  return largest > 0. ? Eigen::VectorXd(y / largest) : y;
}

struct DrawnPair
{
  std::string     title, note;
  Eigen::VectorXd a, b;
};

/// The largest of the first shape points to the right.
DrawnPair drawn_pair(const ComparedShapes &shapes, const coupling::ModePair &pair, double arm)
{
  DrawnPair    own{short_text(shapes.a.modes[std::size_t(pair.a)].frequency_hz, 4) + " | " +
                    short_text(shapes.b.modes[std::size_t(pair.b)].frequency_hz, 4) + " Hz",
                "modes " + std::to_string(pair.a + 1) + " | " + std::to_string(pair.b + 1) + ", MAC " +
                    short_text(pair.assurance, 3),
                drawn(shapes, shapes.a.shapes.col(pair.a), arm), drawn(shapes, shapes.b.shapes.col(pair.b), arm)};
  Eigen::Index largest;
  own.a.cwiseAbs().maxCoeff(&largest);
  const double sign = own.a[largest] < 0. ? -1. : 1.;
  own.a *= sign;
  own.b *= pair.reversed ? -sign : sign;
  return own;
}

/// Measures that move in at least one of the pairs, by largest amplitude; not more than fit the drawing.
std::vector<Eigen::Index> shown_measures(const std::vector<DrawnPair> &pairs)
{
  Eigen::VectorXd size = Eigen::VectorXd::Zero(pairs.front().a.size());
  for (const DrawnPair &pair : pairs)
    size = size.cwiseMax(pair.a.cwiseAbs()).cwiseMax(pair.b.cwiseAbs());
  std::vector<Eigen::Index> order;
  for (Eigen::Index k = 0; k < size.size(); ++k)
    order.push_back(k);
  std::stable_sort(order.begin(), order.end(), [&](auto i, auto j) { return size[i] > size[j]; });
  constexpr std::size_t most_rows = 12; // the height of a panel; smaller parts are in the files
  order.resize(std::min(order.size(), most_rows));
  std::sort(order.begin(), order.end());
  return order;
}

std::string bar_svg(double zero, double y, double value, int colour, const std::string &text)
{
  const double length = (0.5 * panel_width - 6.) * value;
  return svg_hint(text, "<rect class=\"f" + std::to_string(colour) + "\" rx=\"1.5\"" +
                            svg_box(std::min(zero, zero + length), y, std::max(std::abs(length), 0.7), bar) + "/>");
}

std::string panel_svg(const ComparedShapes &shapes, const DrawnPair &pair, const std::vector<Eigen::Index> &measures,
                      double left, double upper)
{
  const double zero = left + 0.5 * panel_width;
  std::string  svg  = svg_text(zero, upper - 22., pair.title, "title", "middle") +
                    svg_text(zero, upper - 6., pair.note, "small", "middle");
  double y = upper;
  for (const Eigen::Index k : measures)
  {
    const std::string name = shapes.measures[std::size_t(k)].path + ": ";
    svg += bar_svg(zero, y + 3., pair.a[k], 0, name + short_text(pair.a[k], 3)) +
           bar_svg(zero, y + 4. + bar, pair.b[k], 1, name + short_text(pair.b[k], 3));
    y += row;
  }
  return svg + svg_line("axis", zero, upper, zero, y);
}

std::string names_svg(const ComparedShapes &shapes, const std::vector<Eigen::Index> &measures, double right,
                      double upper)
{
  std::string svg;
  double      y = upper;
  for (const Eigen::Index k : measures)
  {
    svg += svg_text(right, y + 17., shapes.measures[std::size_t(k)].path, "label", "end");
    y += row;
  }
  return svg;
}

std::string legend_entry(double x, int colour, const std::string &name)
{
  return "<rect class=\"f" + std::to_string(colour) + "\" rx=\"1.5\"" + svg_box(x, 26., 22., bar) + "/>" +
         svg_text(x + 28., 35., name, "label");
}

double widest_name(const ComparedShapes &shapes, const std::vector<Eigen::Index> &measures)
{
  std::size_t letters = 0;
  for (const Eigen::Index k : measures)
    letters = std::max(letters, n_letters(shapes.measures[std::size_t(k)].path));
  return 24. + letter * double(letters);
}

} // namespace

std::string shape_pairs_svg(const ComparedShapes &shapes, double arm)
{
  std::vector<DrawnPair> pairs;
  constexpr std::size_t  most_panels = 8; // two rows of panels, a screen
  constexpr std::size_t  in_a_row    = 4; // four of panel_width side by side are as wide as a chart
  for (const coupling::ModePair &pair : shapes.match.pairs)
    if (shapes.a.modes[std::size_t(pair.a)].frequency_hz > 0. && pairs.size() < most_panels)
      pairs.push_back(drawn_pair(shapes, pair, arm));
  if (pairs.empty())
    return "";
  const auto        measures = shown_measures(pairs);
  const double      left = widest_name(shapes, measures), high = top + row * double(measures.size());
  const std::size_t columns = std::min(pairs.size(), in_a_row), rows = (pairs.size() + columns - 1) / columns;
  const double width = left + (panel_width + gap) * double(columns), height = head_room + high * double(rows) + 20.;
  const std::string title = "Shapes of matched modes";
  std::string       svg   = svg_head(width, height, title) + svg_text(10., 19., title, "title") +
                    legend_entry(12., 0, shapes.a.scene) +
                    legend_entry(60. + letter * double(n_letters(shapes.a.scene)), 1, shapes.b.scene);
  for (std::size_t i = 0; i < pairs.size(); ++i)
  {
    const double upper = head_room + high * double(i / columns) + top - 22.;
    if (i % columns == 0)
      svg += names_svg(shapes, measures, left - 8., upper);
    svg += panel_svg(shapes, pairs[i], measures, left + (panel_width + gap) * double(i % columns), upper);
  }
  return svg +
         svg_text(10., height - 6.,
                  "each shape scaled to a largest amplitude of 1; angles multiplied by " + short_text(arm) + " m",
                  "small") +
         "</svg>\n";
}

} // namespace gestell::apps
