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
  double              begin = std::numeric_limits<double>::quiet_NaN(); ///< nan: as the curves need
  double              end   = std::numeric_limits<double>::quiet_NaN();
  Scale               scale = Scale::linear;
  std::vector<double> ticks{};           ///< empty: chosen
  std::string (*tick_text)(double) = {}; ///< empty: the number, on a logarithmic axis as power of ten

  bool shows(double value) const { return value >= begin && value <= end; }
  /// Whether a value has a place on the axis: it is finite, on a logarithmic one positive.
  bool has_place(double value) const;
};

/// The axis with the ends it lacks taken from values between `low` and `high` (low > high: there are none), a little
/// wider: by the share `room` of their span, on a logarithmic axis by 0.08 of a decade.
/// @throws std::invalid_argument if its end is not above its begin, or a logarithmic one begins at or below zero.
ChartAxis fitted(ChartAxis axis, double low, double high, double room);

struct Tick
{
  double      value;
  std::string text;
};

/// About `count` ticks of a linear axis; of a logarithmic one powers of ten, and 2 and 5 times of them where less
/// than 2.5 powers are in sight.
std::vector<Tick> ticks_of(const ChartAxis &axis, int count);

/// Map of an axis with both ends to the coordinates [first, last] of a picture.
class AxisMap
{
public:
  AxisMap(const ChartAxis &axis, double first, double last);

  /// Place of a value, which must have one; far outside of the picture it is cut off.
  double at(double value) const;

private:
  Scale  scale_;
  double begin_, factor_, first_;
};

} // namespace gestell::apps
