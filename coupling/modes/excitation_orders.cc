#include "coupling/modes/excitation_orders.h"

#include <cmath>

namespace gestell::coupling
{

namespace
{

struct Point
{
  double x, distance, frequency;
};

bool crosses(const Point &a, const Point &b)
{
  return a.distance * b.distance < 0.;
}

/// Collects the points of one line, in their order, into stretches.
class Stretches
{
public:
  Stretches(int order, int line, double band, std::vector<OrderMeeting> &found)
      : order_(order), line_(line), band_(band), found_(found)
  {
  }

  void add(const Point &point)
  {
    const bool near = std::abs(point.distance) <= band_, through = has_last_ && crosses(last_, point);
    if (through)
    {
      const double share = last_.distance / (last_.distance - point.distance);
      take({last_.x + share * (point.x - last_.x), 0., last_.frequency + share * (point.frequency - last_.frequency)});
    }
    if (near)
      take(point);
    else
      open_ = false;
    last_     = point;
    has_last_ = true;
  }

  void interrupt() { open_ = has_last_ = false; }

private:
  void take(const Point &point)
  {
    if (!open_)
      found_.push_back({order_, line_, point.x, point.x, point.x, point.frequency, point.distance});
    open_             = true;
    OrderMeeting &own = found_.back();
    own.end           = point.x;
    if (std::abs(point.distance) < std::abs(own.distance))
    {
      own.x            = point.x;
      own.frequency_hz = point.frequency;
      own.distance     = point.distance;
    }
  }

  int                        order_, line_;
  double                     band_;
  std::vector<OrderMeeting> &found_;
  Point                      last_{};
  bool                       has_last_ = false, open_ = false;
};

} // namespace

std::vector<OrderMeeting> order_meetings(const ModesAlong &along, double f_0, int n_orders, double band)
{
  std::vector<OrderMeeting> found;
  for (int k = 1; f_0 > 0. && k <= n_orders; ++k)
    for (std::size_t line = 0; line < along.free.size(); ++line)
    {
      Stretches stretches(k, int(line), band, found);
      for (const ModesAt &at : along.positions)
        if (line >= at.modes.size())
          stretches.interrupt();
        else if (const double f = at.modes[line].frequency_hz; f > 0.)
          stretches.add({at.x, f / (k * f_0) - 1., f});
        else
          stretches.interrupt();
    }
  return found;
}

} // namespace gestell::coupling
