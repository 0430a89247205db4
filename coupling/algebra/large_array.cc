#include "coupling/algebra/large_array.h"

#include <sys/mman.h>

#include <algorithm>
#include <new>
#include <utility>

namespace gestell::coupling
{

LargeArray::LargeArray(std::size_t size) : bytes_(std::max<std::size_t>(1, size) * sizeof(double))
{
  void *const memory = mmap(nullptr, bytes_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED)
    throw std::bad_alloc();
  madvise(memory, bytes_, MADV_HUGEPAGE); // a wish
  data_ = static_cast<double *>(memory);
}

LargeArray::~LargeArray()
{
  if (data_)
    munmap(data_, bytes_);
}

LargeArray::LargeArray(LargeArray &&other) noexcept
    : data_(std::exchange(other.data_, nullptr)), bytes_(std::exchange(other.bytes_, 0))
{
}

LargeArray &LargeArray::operator=(LargeArray &&other) noexcept
{
  std::swap(data_, other.data_);
  std::swap(bytes_, other.bytes_);
  return *this;
}

} // namespace gestell::coupling
