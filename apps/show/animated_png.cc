#include "apps/show/animated_png.h"

#include <array>
#include <stdexcept>

namespace gestell::apps
{
namespace
{

const std::string signature = "\x89PNG\r\n\x1a\n";

std::string big_endian(std::uint32_t x, int n_bytes = 4)
{
  std::string text;
  for (int shift = 8 * (n_bytes - 1); shift >= 0; shift -= 8)
    text += static_cast<char>(x >> shift & 0xff);
  return text;
}

std::uint32_t number_at(const std::string &bytes, std::size_t at)
{
  std::uint32_t x = 0;
  for (std::size_t i = at; i < at + 4; ++i)
    x = x << 8 | static_cast<unsigned char>(bytes[i]);
  return x;
}

/// CRC-32 of ISO 3309, polynomial 0xedb88320.
std::uint32_t checksum(const std::string &bytes)
{
  static const auto table = []
  {
    std::array<std::uint32_t, 256> remainders{};
    for (std::uint32_t i = 0; i < 256; ++i)
    {
      std::uint32_t c = i;
      for (int k = 0; k < 8; ++k)
        c = c & 1 ? 0xedb88320u ^ c >> 1 : c >> 1;
      remainders[i] = c;
    }
    return remainders;
  }();
  std::uint32_t c = 0xffffffffu;
  for (const char byte : bytes)
    c = table[(c ^ static_cast<unsigned char>(byte)) & 0xff] ^ c >> 8;
  return ~c;
}

std::string chunk(const std::string &kind, const std::string &data)
{
  return big_endian(static_cast<std::uint32_t>(data.size())) + kind + data + big_endian(checksum(kind + data));
}

} // namespace

/// How a frame is shown: whole, 1/rate s, in place of the one before.
void AnimatedPng::add_control(const std::string &head)
{
  frames_ += chunk("fcTL", big_endian(sequence_++) + head.substr(0, 8) + big_endian(0) + big_endian(0) +
                               big_endian(1, 2) + big_endian(static_cast<std::uint32_t>(rate_), 2) + big_endian(0, 2));
}

void AnimatedPng::add(const std::string &png)
{
  if (png.compare(0, signature.size(), signature) != 0)
    throw std::invalid_argument("AnimatedPng: not a PNG");
  for (std::size_t at = signature.size(); at + 12 <= png.size();)
  {
    const std::size_t length = number_at(png, at);
    const std::string kind = png.substr(at + 4, 4), data = png.substr(at + 8, length);
    if (kind == "IHDR")
    {
      head_ = n_frames_ == 0 ? data : head_;
      add_control(data);
    }
    if (kind == "IDAT")
      frames_ += n_frames_ == 0 ? chunk(kind, data) : chunk("fdAT", big_endian(sequence_++) + data);
    at += 12 + length;
  }
  ++n_frames_;
}

std::string AnimatedPng::bytes() const
{
  if (n_frames_ == 0)
    return "";
  return signature + chunk("IHDR", head_) + chunk("acTL", big_endian(n_frames_) + big_endian(0)) + frames_ +
         chunk("IEND", "");
}

} // namespace gestell::apps
