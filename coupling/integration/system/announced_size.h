#pragma once

#include <cstdint>

namespace gestell::coupling
{

/// Whether `count` objects, each of at least the given number of bytes, fit into `left` bytes; for any count claimed by
/// a file header, without overflow of a product.
constexpr bool stand_in(std::uint64_t left, std::uint64_t count, std::uint64_t bytes_of_each)
{
  return bytes_of_each == 0 || count <= left / bytes_of_each;
}

/// The same for a matrix; one without rows or without columns does not fit.
constexpr bool stand_in(std::uint64_t left, std::uint64_t rows, std::uint64_t columns, std::uint64_t bytes_of_each)
{
  return rows == 0 || columns == 0 ||
         (stand_in(left, rows, bytes_of_each) && stand_in(left / rows, columns, bytes_of_each));
}

/// Limit of the rows or columns of a sparse matrix in the header of a small file: its entries do not limit them, as for
/// a few dampers of a large frame, and each takes 4 bytes of an index.
constexpr std::int64_t most_empty_lines = 100'000;

/// Whether a sparse matrix in a file of this number of bytes may have this number of rows or columns: up to the number
/// of bytes, since a matrix of a frame has more bytes than rows; or up to `known`, the rows of an earlier matrix.
constexpr bool may_have_lines(std::int64_t lines, std::int64_t bytes, std::int64_t known)
{
  return lines <= bytes || lines <= known || lines <= most_empty_lines;
}

} // namespace gestell::coupling
