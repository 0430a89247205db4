#pragma once

#include <array>
#include <string>

namespace gestell::apps
{

/// Exponents of metre, kilogram and second.  Angles are numbers: rad = 1.
using Dimension = std::array<double, 3>;

/// The unit of counting in a value.  Its dimension does not distinguish radians from revolutions, a factor of 2 pi.  Of
/// two factors the one later in this list determines that of the product.
enum class Counts
{
  nothing,
  pi,          ///< a number that contains pi
  minutes,     ///< contains minutes or hours: its inverse may count revolutions
  turns,       ///< Hz
  shaft_turns, ///< 1/min, rpm, r/min: shaft revolutions; the value is in rad/s, as a frequency it is divided by 2 pi
  radians      ///< rad, deg
};

/// A value in SI units.
struct Quantity
{
  double    value = 0.;
  Dimension dimension{};
  bool      checked = true; ///< false: made from a plain number of [parameters], compatible with any dimension
  Counts    counts  = Counts::nothing;
};

/// The kind of quantity that a key requires, as text and in exponents: {"length", "40 mm", {1, 0, 0}}.
struct Kind
{
  std::string name, example;
  Dimension   dimension;
  Counts      refused     = Counts::nothing; ///< revolutions for a value in radians, radians for a frequency
  int         metre_range = 0;               ///< number of additional powers of a metre that are accepted (matrices)
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

/// Whether exponents are equal up to rounding.
bool equal(const Dimension &a, const Dimension &b);

/// "kg m^2/s^2", or "a plain number".
std::string describe(const Dimension &dimension);
std::string with_article(const Kind &kind); ///< "a length", "an angle"

/// Value of `quantity` if it is of `kind`, in the unit of the kind: for shaft revolutions rad/s or, as a frequency, Hz.
/// @throws std::invalid_argument: needs a length such as "40 mm", got 3 kg.
double value_as(const Quantity &quantity, const Kind &kind, const std::string &text);

/// @param is_zero  a zero with any unit is of every kind; `shown`: the quantity as printed after its text in messages,
/// "3 kg".
/// @throws std::invalid_argument if `quantity` is not of `kind`
void check_kind(const Quantity &quantity, bool is_zero, const Kind &kind, const std::string &text,
                const std::string &shown);

/// 1, or 1 / 2 pi for shaft revolutions that are required as a frequency.
double per_radian(Counts counts, const Kind &kind);

} // namespace gestell::apps
