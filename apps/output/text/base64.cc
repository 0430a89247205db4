#include "apps/output/text/base64.h"

namespace gestell::apps
{
namespace
{

template <typename Number>
std::string encoded(const std::vector<Number> &numbers)
{
  return base64(std::string(reinterpret_cast<const char *>(numbers.data()), numbers.size() * sizeof(Number)));
}

} // namespace

std::string base64(const std::string &bytes)
{
  static const char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string       text;
  text.reserve(4 * (bytes.size() / 3 + 1));
  for (std::size_t i = 0; i < bytes.size(); i += 3)
  {
    const auto byte = [&](std::size_t k) { return k < bytes.size() ? static_cast<unsigned char>(bytes[k]) : 0u; };
    const std::uint32_t three = byte(i) << 16u | byte(i + 1) << 8u | byte(i + 2);
    for (unsigned k = 0; k < 4; ++k)
      text += i + k > bytes.size() ? '=' : letters[three >> (18u - 6u * k) & 63u];
  }
  return text;
}

std::string base64(const std::vector<float> &numbers)
{
  return encoded(numbers);
}

std::string base64(const std::vector<std::int16_t> &numbers)
{
  return encoded(numbers);
}

std::string base64(const std::vector<std::uint8_t> &numbers)
{
  return encoded(numbers);
}

std::string base64(const std::vector<std::uint16_t> &numbers)
{
  return encoded(numbers);
}

std::string base64(const std::vector<std::uint32_t> &numbers)
{
  return encoded(numbers);
}

} // namespace gestell::apps
