#pragma once

#include <array>
#include <charconv>
#include <cstddef>
#include <vector>

namespace gestell::apps
{

/// Rows of numbers in full precision, parted by commas, in pieces of some kilobytes; an incomplete last row is dropped.
/// @param put  takes the address and the length of a piece
template <class Put>
void write_number_rows(const std::vector<double> &numbers, std::size_t width, const Put &put)
{
  std::array<char, 65536>  piece;
  constexpr std::ptrdiff_t longest = 25; // "-1.2345678901234567e-123,"
  char                    *end     = piece.data();
  for (std::size_t i = 0, n = width > 0 ? numbers.size() / width * width : 0; i < n; ++i)
  {
    if (piece.data() + piece.size() - end < longest)
    {
      put(piece.data(), std::size_t(end - piece.data()));
      end = piece.data();
    }
    end    = std::to_chars(end, end + longest, numbers[i]).ptr;
    *end++ = (i + 1) % width == 0 ? '\n' : ',';
  }
  put(piece.data(), std::size_t(end - piece.data()));
}

} // namespace gestell::apps
