#pragma once

#include "apps/scene/language/parse_expression.h"

namespace gestell::apps
{

/**
 * Reads "40 mm", "2*crank_radius - 8 mm", "600 kN s/m", "1/2 * 3 kg".
 *
 *     sum     = product { (+|-) product }
 *     product = factor { (*|/) factor }
 *     factor  = (+|-) factor | power
 *     power   = operand [ ^ factor ]
 *     operand = number [units] | ( sum ) [units] | function ( sum {, sum} ) | if ( sum (<|<=|>|>=) sum , sum , sum )
 *             | pi | parameter | units
 *     units   = unit[^n] { unit[^n] | / unit[^n] | 1/unit[^n] }
 *
 * The units that follow a number belong to it more tightly than any operator; "N s/m" is (N s)/m and "kg m^2" squares
 * the metre only.  What reads in two ways is refused: "N/m s", "1/2 mm", and "3 g" if a parameter is called g.  Where
 * an operand is expected a parameter comes before a unit of the same name.  A full list of units is in
 * docs/scene/values.md.
 *
 * A number per minute or hour counts the turns of a shaft, as on every name plate, however it is written: "1500 1/min",
 * "1500/min", "1500/(1 min)", "1500 min^-1", "1500 r/min", "1500 rpm".  It is 2 pi 25 rad/s as an angular speed and
 * 25 Hz as a frequency.  Multiplied or divided by anything but plain numbers and times it could be meant in either way,
 * and is refused.
 *
 * Formulas, expressions with variables, have the same grammar: parse_expression().
 *
 * @param names  of all parameters, `kind` what is needed, for proposals.
 * @throws std::invalid_argument with what was expected and where in the text.
 */
Quantity parse_quantity(const std::string &text, const NameLookup &parameters,
                        const std::vector<std::string> &names = {}, const Kind *kind = nullptr);

/// True for names that parameters cannot have: functions and pi.
bool is_reserved_name(const std::string &name);

} // namespace gestell::apps
