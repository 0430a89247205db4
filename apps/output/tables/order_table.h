#pragma once

#include "apps/output/values/order_tracking.h"

#include <string>

namespace gestell::apps
{

/// orders.csv: a row per window, for each signal the amplitude of every order; full precision, SI.
std::string orders_csv(const OrderTracking &tracking);

} // namespace gestell::apps
