#pragma once

#include <limits>
#include <string>
#include <vector>

namespace gestell::apps
{

/// Multiples of 1, 2 or 5 times a power of ten in [low, high], about `count` of them.
std::vector<double> nice_ticks(double low, double high, int count);

enum class Scale
{
  linear,
  logarithmic
};

/// One axis of a chart, with the window of values it shows.
struct ChartAxis
{
  std::string         label{};
  double              begin = std::numeric_limits<double>::quiet_NaN(); ///< nan: from the curves
  double              end   = std::numeric_limits<double>::quiet_NaN();
  Scale               scale = Scale::linear;
  std::vector<double> ticks{};           ///< empty: chosen
  std::string (*tick_text)(double) = {}; ///< empty: the number, on a logarithmic axis as power of ten

  bool shows(double value) const { return value >= begin && value <= end; }
  /// Whether the axis can show a value: it is finite, and positive on a logarithmic axis.
  bool has_place(double value) const;
};

/// The axis, with missing limits taken from the range [low, high] of the values (low > high: there are no values).  The
/// range is widened by the share `room` of its span, on a logarithmic axis by 0.08 of a decade.
/// @throws std::invalid_argument if the end is not above the start, or a logarithmic axis starts at or below zero.
ChartAxis fitted(ChartAxis axis, double low, double high, double room);

struct Tick
{
  double      value;
  std::string text;
};

/// About `count` ticks of a linear axis; on a logarithmic axis powers of ten, and their 2-fold and 5-fold where the
/// window spans less than 2.5 decades.
std::vector<Tick> ticks_of(const ChartAxis &axis, int count);

/// Map of an axis with both ends to the coordinates [first, last] of a picture.
class AxisMap
{
public:
  AxisMap(const ChartAxis &axis, double first, double last);

  /// Picture coordinate of a value for which has_place() is true; clamped far outside the picture.
  double at(double value) const;

private:
  Scale  scale_;
  double begin_, factor_, first_;
};

} // namespace gestell::apps
