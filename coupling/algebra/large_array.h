#pragma once

#include <cstddef>

namespace gestell::coupling
{

/// Numbers without values, on large pages where the system has them: memory is allocated on first access, and
/// sequential reads do not wait for address translation. Large, or empty.
class LargeArray
{
public:
  LargeArray() = default;
  /// @throws std::bad_alloc
  explicit LargeArray(std::size_t size);
  ~LargeArray();
  LargeArray(LargeArray &&other) noexcept;
  LargeArray &operator=(LargeArray &&other) noexcept;

  /// Aligned to 64 bytes; null if made without a size.
  double       *data() { return data_; }
  const double *data() const { return data_; }

private:
  double     *data_  = nullptr;
  std::size_t bytes_ = 0;
};

} // namespace gestell::coupling
