#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace gestell::apps
{

/// Files of one instant or one mode: frame, mechanism.
struct PictureFrame
{
  double                             time = 0.; ///< of the collection: [s], or the number of a mode
  std::vector<std::filesystem::path> parts;     ///< .vtp
};

/// A film, or with one frame a picture.
struct PictureSeries
{
  std::string               name;    ///< of the file, without ending
  std::string               caption; ///< "{t}" stands for the time, "{times}" the enlargement, "{frequency}" a mode's
  std::vector<PictureFrame> frames;
  bool                      swings = false; ///< one frame that is drawn over a cycle, of a mode
  bool                      rests  = false; ///< without its displacements
};

struct PictureRequest
{
  std::filesystem::path      folder; ///< for the pictures
  std::vector<PictureSeries> series;
  int                        width = 1000, height = 800; ///< [pixels]
  double                     enlargement       = 0.;     ///< of displacements; 0: chosen
  bool                       films             = true;
  int                        frames_per_second = 25;

  std::function<void(const std::string &phase, double share)> progress;
};

/// What the plugin offers: draws all of it.  @return the files written.
/// @throws std::invalid_argument of a file that is no surface of VTK; std::runtime_error if one cannot be written.
using DrawPictures = std::vector<std::string>(const PictureRequest &request);

} // namespace gestell::apps
