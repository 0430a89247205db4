#pragma once

namespace gestell::coupling
{

/**
 * Reads the number that begins at `text`, behind blanks, as files write it: with a decimal point, whatever the locale
 * of the process.  Too small a number is 0, too large a one infinite; infinity and NaN are read as such, hexadecimal
 * digits are not.
 *
 * @return  behind the number; `text` if there is none
 */
const char *read_number(const char *text, double &value);

} // namespace gestell::coupling
