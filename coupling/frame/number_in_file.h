#pragma once

namespace gestell::coupling
{

/**
 * Reads the number at `text`, after blanks, in file format: with a decimal point, independent of the locale.  Too small
 * a number is 0, too large a one infinite; infinity and NaN are read as such, hexadecimal digits are not.
 *
 * @return  end of the number; `text` if there is none
 */
const char *read_number(const char *text, double &value);

} // namespace gestell::coupling
