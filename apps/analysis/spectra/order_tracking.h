#pragma once

#include "apps/analysis/spectra/spectrum_values.h"
#include "apps/scene/values/requests.h"
#include "coupling/simulation/run_result.h"

#include <optional>

namespace gestell::apps
{

/**
 * Orders of the first rotor whose angle or speed is a signal of the scene.  Every signal is resampled at equal angles
 * phi and fitted over windows of four revolutions, at least one revolution apart,
 *
 *     y = a + b phi + c phi^2 + sum_k (C_k cos k phi + S_k sin k phi),     A_k = hypot(C_k, S_k),
 *
 * by least squares with Hann weights.
 *
 * The number of orders is limited to those that the rows of the history resolve with three samples per period, and to
 * eight.  Empty if the scene has no such signal, or the rotor makes fewer than sixteen revolutions in one direction.
 *
 * Source: K. R. Fyfe, E. D. S. Munck, Analysis of computed order tracking, Mechanical Systems and Signal Processing 11
 * (1997), 187-205.
 */
std::optional<OrderTracking> order_tracking(const Scene &scene, const coupling::RunResult &run);

} // namespace gestell::apps
