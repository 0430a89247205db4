#pragma once

#include <cstddef>
#include <istream>
#include <memory>
#include <string>

namespace gestell::coupling
{

/// SHA-256 of bytes that are added in pieces.
/// @throws std::runtime_error if OpenSSL does not provide it.
class Sha256
{
public:
  Sha256();
  Sha256     &update(const void *bytes, std::size_t size);
  Sha256     &update(const std::string &text) { return update(text.data(), text.size()); }
  std::string hexadecimal(); ///< 64 digits; the object cannot be used afterwards

private:
  struct Context;
  std::shared_ptr<Context> context_;
};

/// SHA-256 of the rest of a stream.
std::string sha256_of(std::istream &in);

/// @throws std::invalid_argument if the file cannot be read.
std::string sha256_of_file(const std::string &file);

} // namespace gestell::coupling
