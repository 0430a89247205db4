#pragma once

#include <cstdint>
#include <string>

namespace gestell::apps
{

/// A film that browsers play: PNG pictures of one size, one after the other without end (APNG 1.0: acTL, fcTL, fdAT).
class AnimatedPng
{
public:
  explicit AnimatedPng(int frames_per_second) : rate_(frames_per_second) {}

  /// @param png  bytes of a whole PNG file.  @throws std::invalid_argument if it is none
  void add(const std::string &png);

  /// The bytes of the film; nothing without a picture.
  std::string bytes() const;

private:
  void add_control(const std::string &head);

  int           rate_;
  std::uint32_t n_frames_ = 0, sequence_ = 0;
  std::string   head_, frames_; // data of the first IHDR, chunks
};

} // namespace gestell::apps
