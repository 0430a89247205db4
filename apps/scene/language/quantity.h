#pragma once

#include <array>
#include <string>

namespace gestell::apps
{

/// Exponents of metre, kilogram and second.  Angles are numbers: rad = 1.
using Dimension = std::array<double, 3>;

/// What a value counts.  Its dimension does not say whether radians or turns, a factor of 2 pi.
/// Of two factors the later one here tells what the product counts.
enum class Counts
{
  nothing,
  pi,          ///< a number with pi in it
  minutes,     ///< minutes or hours are in it: its inverse may count turns
  turns,       ///< Hz
  shaft_turns, ///< 1/min, rpm, r/min: turns of a shaft; the value is in rad/s, as a frequency it is divided by 2 pi
  radians      ///< rad, deg
};

/// A value in SI units.
struct Quantity
{
  double    value = 0.;
  Dimension dimension{};
  bool      checked = true; ///< false: made from a plain number of [parameters], so of any dimension
  Counts    counts  = Counts::nothing;
};

/// What a key needs, in words and in exponents: {"length", "40 mm", {1, 0, 0}}.
struct Kind
{
  std::string name, example;
  Dimension   dimension;
  Counts      refused     = Counts::nothing; ///< where radians are counted turns, of a frequency radians
  int         metre_range = 0;               ///< so many more powers of a metre are right as well (matrices)
};

namespace kind
{
inline const Kind number{"number", "0.3", {0, 0, 0}};
inline const Kind angle{"angle", "20 deg", {0, 0, 0}, Counts::turns};
inline const Kind length{"length", "40 mm", {1, 0, 0}};
inline const Kind area{"area", "120 mm^2", {2, 0, 0}};
inline const Kind volume{"volume", "50 cm^3", {3, 0, 0}};
inline const Kind mass{"mass", "3 t", {0, 1, 0}};
inline const Kind inertia{"moment of inertia", "250 kg m^2", {2, 1, 0}};
inline const Kind unbalance{"unbalance", "2.4 g m", {1, 1, 0}};
inline const Kind time{"time", "10 us", {0, 0, 1}};
inline const Kind frequency{"frequency", "200 Hz", {0, 0, -1}, Counts::radians};
inline const Kind speed{"speed", "0.2 m/s", {1, 0, -1}};
inline const Kind angular_speed{"angular speed", "30 1/min", {0, 0, -1}, Counts::turns};
inline const Kind acceleration{"acceleration", "9.81 m/s^2", {1, 0, -2}};
inline const Kind force{"force", "46 kN", {1, 1, -2}};
inline const Kind torque{"torque", "240 N m", {2, 1, -2}};
inline const Kind stiffness{"stiffness", "420 kN/mm", {0, 1, -2}};
inline const Kind damping{"damping", "600 kN s/m", {0, 1, -1}};
inline const Kind bedding{"stiffness per area", "40 N/mm^3", {-2, 1, -2}};
inline const Kind damping_per_area{"damping per area", "600 kN s/m^3", {-2, 1, -1}};
inline const Kind torsional_stiffness{"torsional stiffness", "1300 kN m/rad", {2, 1, -2}};
inline const Kind torsional_damping{"torsional damping", "3 kN m s/rad", {2, 1, -1}, Counts::turns};
inline const Kind cubic_stiffness{"cubic stiffness", "5 N/mm^3", {-2, 1, -2}};
inline const Kind torsional_cubic_stiffness{"torsional cubic stiffness", "5 N m/rad^3", {2, 1, -2}};
inline const Kind pressure{"pressure", "210 GPa", {-1, 1, -2}};
inline const Kind density{"density", "7850 kg/m^3", {-3, 1, 0}};
inline const Kind mass_entry{"entry of a mass matrix", "250 kg", {0, 1, 0}, Counts::nothing, 2};
inline const Kind damping_entry{"entry of a damping matrix", "200 kN s/m", {0, 1, -1}, Counts::nothing, 2};
inline const Kind stiffness_entry{"entry of a stiffness matrix", "3200 kN/mm", {0, 1, -2}, Counts::nothing, 2};
} // namespace kind

/// Exponents are equal up to rounding.
bool equal(const Dimension &a, const Dimension &b);

/// "kg m^2/s^2", or "a plain number".
std::string describe(const Dimension &dimension);
std::string with_article(const Kind &kind); ///< "a length", "an angle"

/// Value of `quantity` if it is of `kind`, in the unit of the kind: of turns of a shaft rad/s or, as a frequency, Hz.
/// @throws std::invalid_argument: needs a length such as "40 mm", got 3 kg.
double value_as(const Quantity &quantity, const Kind &kind, const std::string &text);

/// @param is_zero  zero of anything is of every kind; `shown`: the quantity as messages tell it behind its text, "3
/// kg".
/// @throws std::invalid_argument if `quantity` is not of `kind`
void check_kind(const Quantity &quantity, bool is_zero, const Kind &kind, const std::string &text,
                const std::string &shown);

/// 1, or for turns of a shaft that are needed as a frequency 1 / 2 pi.
double per_radian(Counts counts, const Kind &kind);

} // namespace gestell::apps
