#include "coupling/frame/sha256.h"

#include <openssl/evp.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <vector>

namespace gestell::coupling
{

struct Sha256::Context
{
  EVP_MD_CTX *digest = EVP_MD_CTX_new();
  Context()          = default;
  ~Context() { EVP_MD_CTX_free(digest); }
  Context(const Context &)            = delete;
  Context &operator=(const Context &) = delete;
};

Sha256::Sha256() : context_(std::make_shared<Context>())
{
  if (!context_->digest || EVP_DigestInit_ex(context_->digest, EVP_sha256(), nullptr) != 1)
    throw std::runtime_error("Sha256: OpenSSL does not offer SHA-256; check the installation of libssl");
}

Sha256 &Sha256::update(const void *bytes, std::size_t size)
{
  EVP_DigestUpdate(context_->digest, bytes, size);
  return *this;
}

std::string Sha256::hexadecimal()
{
  unsigned char bytes[EVP_MAX_MD_SIZE];
  unsigned int  size = 0;
  EVP_DigestFinal_ex(context_->digest, bytes, &size);
  std::string text;
  char        digits[3];
  for (unsigned int i = 0; i < size; ++i)
  {
    std::snprintf(digits, sizeof digits, "%02x", bytes[i]);
    text += digits;
  }
  return text;
}

std::string sha256_of(std::istream &in)
{
  Sha256            hash;
  std::vector<char> block(1 << 20);
  while (in.read(block.data(), std::streamsize(block.size())) || in.gcount() > 0)
    hash.update(block.data(), std::size_t(in.gcount()));
  return hash.hexadecimal();
}

std::string sha256_of_file(const std::string &name)
{
  std::ifstream   file(name, std::ios::binary);
  std::error_code error;
  if (!file || std::filesystem::is_directory(name, error))
    throw std::invalid_argument(name + ": cannot be read; check the path and its permissions");
  return sha256_of(file);
}

} // namespace gestell::coupling
