#pragma once

namespace gestell
{

/// rad per revolution: omega [rad/s] = two_pi f [Hz].
inline constexpr double two_pi = 6.283185307179586;

} // namespace gestell
