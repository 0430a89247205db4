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

/// An animation, or with a single frame a picture.
struct PictureSeries
{
  std::string               name;    ///< of the file, without extension
  std::string               caption; ///< with "{t}" for the time, "{times}" the enlargement, "{frequency}" a mode's
  std::vector<PictureFrame> frames;
  bool                      swings = false; ///< animates one frame of a mode over a cycle
  bool                      rests  = false; ///< without displacements
};

struct PictureRequest
{
  std::filesystem::path      folder; ///< output folder
  std::vector<PictureSeries> series;
  int                        width = 1000, height = 800; ///< [pixels]
  double                     enlargement       = 0.;     ///< of displacements; 0: automatic
  bool                       films             = true;
  int                        frames_per_second = 25;

  std::function<void(const std::string &phase, double share)> progress;
};

/// Entry point of the plugin: draws all pictures.  @return the files written.
/// @throws std::invalid_argument for a file that is not a VTK surface; std::runtime_error if one cannot be written.
using DrawPictures = std::vector<std::string>(const PictureRequest &request);

} // namespace gestell::apps
