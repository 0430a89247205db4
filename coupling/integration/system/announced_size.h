#pragma once

#include <cstdint>

namespace gestell::coupling
{

/// Whether `count` things of at least so many bytes each stand in `left` bytes; for any count, which a head of a file
/// only announces: no product overflows.
constexpr bool stand_in(std::uint64_t left, std::uint64_t count, std::uint64_t bytes_of_each)
{
  return bytes_of_each == 0 || count <= left / bytes_of_each;
}

/// The same of a matrix; one without rows or without columns stands in nothing.
constexpr bool stand_in(std::uint64_t left, std::uint64_t rows, std::uint64_t columns, std::uint64_t bytes_of_each)
{
  return rows == 0 || columns == 0 ||
         (stand_in(left, rows, bytes_of_each) && stand_in(left / rows, columns, bytes_of_each));
}

/// Rows or columns of a sparse matrix that a small file may announce: its entries do not bound them, as a few dampers
/// of a large frame, and each takes 4 bytes of an index.
constexpr std::int64_t most_empty_lines = 100'000;

/// Whether a sparse matrix in a file of so many bytes may have so many rows, or columns: as many as the file has bytes,
/// since a matrix of a frame has more bytes than rows; as many as `known`, those of a matrix that was read before.
constexpr bool may_have_lines(std::int64_t lines, std::int64_t bytes, std::int64_t known)
{
  return lines <= bytes || lines <= known || lines <= most_empty_lines;
}

} // namespace gestell::coupling
