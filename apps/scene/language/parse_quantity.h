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
 * Units after a number bind more tightly than any operator; "N s/m" is (N s)/m, and "kg m^2" squares only the metre.
 * Ambiguous text is rejected: "N/m s", "1/2 mm", and "3 g" if a parameter is called g.  In place of an operand a
 * parameter has priority over a unit of the same name.  A full list of units is in docs/reference/scene/values.md.
 *
 * A number per minute or hour is a number of shaft revolutions, as on every name plate, in any notation: "1500 1/min",
 * "1500/min", "1500/(1 min)", "1500 min^-1", "1500 r/min", "1500 rpm".  It is 2 pi 25 rad/s as an angular speed and 25
 * Hz as a frequency.  A product or quotient of it with anything except plain numbers and times is ambiguous, and is
 * rejected.
 *
 * Formulas, expressions with variables, have the same grammar: parse_expression().
 *
 * @param names  of all parameters, `kind` the required kind, for proposals.
 * @throws std::invalid_argument with the expected input and the position in the text.
 */
Quantity parse_quantity(const std::string &text, const NameLookup &parameters,
                        const std::vector<std::string> &names = {}, const Kind *kind = nullptr);

/// True for names that parameters cannot have: functions and pi.
bool is_reserved_name(const std::string &name);

} // namespace gestell::apps
