#pragma once

namespace gestell
{

/// rad per turn: omega [rad/s] = two_pi f [Hz].
inline constexpr double two_pi = 6.283185307179586;

} // namespace gestell
