#pragma once

#include <cstddef>
#include <memory>
#include <string>

namespace gestell::coupling
{

/// SHA-256 of bytes as they come.
/// @throws std::runtime_error if OpenSSL does not offer it.
class Sha256
{
public:
  Sha256();
  Sha256     &update(const void *bytes, std::size_t size);
  Sha256     &update(const std::string &text) { return update(text.data(), text.size()); }
  std::string hexadecimal(); ///< 64 digits; the object is spent then

private:
  struct Context;
  std::shared_ptr<Context> context_;
};

/// Of the bytes of a file behind its first `skip` ones.
/// @throws std::invalid_argument if it cannot be read.
std::string sha256_of_file(const std::string &file, std::size_t skip = 0);

} // namespace gestell::coupling
