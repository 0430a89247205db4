#include "apps/output/tables/order_table.h"

#include "fem/values/number_text.h"

namespace gestell::apps
{

std::string orders_csv(const OrderTracking &tracking)
{
  std::string csv = "t [s],speed [1/min]";
  for (const OrderedSignal &signal : tracking.signals)
    for (const int order : tracking.orders)
      csv += ',' + signal.name + " order " + std::to_string(order) + " [" + signal.unit + ']';
  csv += '\n';
  for (std::size_t window = 0; window < tracking.t.size(); ++window)
  {
    append_exact(csv, tracking.t[window]);
    append_exact(csv += ',', tracking.speed_rpm[window]);
    for (const OrderedSignal &signal : tracking.signals)
      for (const std::vector<double> &order : signal.amplitudes)
        append_exact(csv += ',', order[window]);
    csv += '\n';
  }
  return csv;
}

} // namespace gestell::apps
