#pragma once

namespace gestell::coupling
{

/**
 * Reads the number at `text`, after blanks, with a decimal point, independent of the locale.  A number that is too
 * small is read as 0, one that is too large as infinity; infinity and NaN are accepted, hexadecimal digits are not.
 *
 * @return  pointer to the end of the number; `text` if there is none
 */
const char *read_number(const char *text, double &value);

} // namespace gestell::coupling
