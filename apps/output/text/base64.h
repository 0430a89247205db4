#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace gestell::apps
{

/// Base64 of bytes (RFC 4648, section 4).
std::string base64(const std::string &bytes);

/// Base64 of numbers in the byte order of the machine, which is little-endian for every current browser.
std::string base64(const std::vector<float> &numbers);
std::string base64(const std::vector<std::int16_t> &numbers);
std::string base64(const std::vector<std::uint8_t> &numbers);
std::string base64(const std::vector<std::uint16_t> &numbers);
std::string base64(const std::vector<std::uint32_t> &numbers);

} // namespace gestell::apps
