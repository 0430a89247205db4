// The door of the plugin.
#include "apps/output/folder/own_folder.h"
#include "apps/show/renderer.h"
#include "coupling/frame/atomic_file.h"

#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkOggTheoraWriter.h>
#include <vtkPNGWriter.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>

namespace gestell::apps
{
namespace
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

/// Adds the display data of a frame: whole image, duration 1/rate s, replaces the previous frame.
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

namespace fs = std::filesystem;

void enclose(const Parts &parts, double *box)
{
  for (const auto &part : parts)
  {
    const double *own = part->GetBounds();
    for (int d = 0; d < 3; ++d)
    {
      box[2 * d]     = std::min(box[2 * d], own[2 * d]);
      box[2 * d + 1] = std::max(box[2 * d + 1], own[2 * d + 1]);
    }
  }
}

double diagonal(const double *box)
{
  return std::hypot(box[1] - box[0], box[3] - box[2], box[5] - box[4]);
}

double round_number(double x)
{
  const double power = std::pow(10., std::floor(std::log10(x)));
  return x >= 5. * power ? 5. * power : x >= 2. * power ? 2. * power : power;
}

std::string number(double x)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", x);
  return text;
}

std::string with(std::string text, const std::string &word, const std::string &value)
{
  if (const auto at = text.find(word); at != std::string::npos)
    text.replace(at, word.size(), value);
  return text;
}

std::string frequency_of(const Parts &parts)
{
  for (const auto &part : parts)
    if (vtkDataArray *f = part->GetFieldData()->GetArray("frequency [Hz]"))
      return number(std::round(f->GetTuple1(0) * 1e3) * 1e-3) + " Hz";
  return "";
}

/// The bytes of the picture as PNG.
std::string png_of(vtkImageData *image)
{
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(image);
  writer->WriteToMemoryOn();
  writer->Write();
  const vtkUnsignedCharArray *bytes = writer->GetResult();
  return {reinterpret_cast<const char *>(const_cast<vtkUnsignedCharArray *>(bytes)->GetPointer(0)),
          static_cast<std::size_t>(bytes->GetNumberOfValues())};
}

/// Film of the images that are given to it, twice: for players of films and for browsers.
class Film
{
public:
  /// @param name  of its files, without ending
  Film(OwnFolder &folder, const std::string &name, int rate)
      : folder_(folder), name_(name), film_(folder.claim(name + ".ogv").string()), browser_(rate)
  {
    writer_->SetFileName(film_.place().c_str());
    writer_->SetRate(rate);
    writer_->SetQuality(2);
  }
  void add(vtkImageData *image)
  {
    writer_->SetInputData(image);
    if (!started_)
      writer_->Start();
    started_ = true;
    writer_->Write();
    require_written();
    browser_.add(png_of(image));
  }
  void end()
  {
    if (started_)
    {
      writer_->End();
      require_written();
      film_.finish();
    }
    folder_.write(name_ + ".apng", browser_.bytes());
  }

private:
  /// The writer ignores errors of the disk, so that a probe file next to the film is written.
  void require_written()
  {
    if (writer_->GetError() || probe(folder_.path()))
      throw coupling::WriteFailure(film_.path(), std::make_error_code(std::errc::no_space_on_device));
  }

  OwnFolder                          &folder_;
  std::string                         name_;
  coupling::FileBeside                film_;
  vtkSmartPointer<vtkOggTheoraWriter> writer_ = vtkSmartPointer<vtkOggTheoraWriter>::New();
  AnimatedPng                         browser_;
  bool                                started_ = false;
};

/// One series after the other.
class Drawing
{
public:
  explicit Drawing(const PictureRequest &request)
      : request_(request), folder_(request.folder), renderer_(request.width, request.height)
  {
  }

  std::vector<std::string> draw(const PictureSeries &series, double done)
  {
    done_ = done;
    files_.clear();
    double box[6] = {1e300, -1e300, 1e300, -1e300, 1e300, -1e300}, most = 0.;
    for (const PictureFrame &frame : series.frames)
    {
      const Parts parts = read_parts(frame);
      enclose(parts, box);
      // of the frame only; for a mode, whose size is arbitrary, of all parts
      most = std::max(most, largest_displacement(series.swings ? parts : Parts{parts.front()}));
    }
    if (series.rests)
      most = 0.;
    const double size = diagonal(box);
    // largest displacement as part of the machine's size, as in pictures of a report
    constexpr double shown_size    = 0.05;
    constexpr double mode_in_files = 1.; // modes are written as they are shown
    double           times         = series.rests                ? 0.
                                     : series.swings             ? mode_in_files
                                     : request_.enlargement > 0. ? request_.enlargement
                                     : most > 0. && size > 0.    ? round_number(shown_size * size / most)
                                                                 : 1.;
    renderer_.look_at(box);
    series.swings ? mode(series, times, most) : motion(series, times, most);
    return files_;
  }

private:
  std::string caption(const PictureSeries &series, const PictureFrame &frame, const Parts &parts, double times) const
  {
    return with(with(with(series.caption, "{t}", number(frame.time)), "{times}", number(times)), "{frequency}",
                frequency_of(parts));
  }

  void tell_file(const std::string &name) { files_.push_back((request_.folder / name).string()); }

  void write(const std::string &name, vtkImageData *image) { folder_.write(name, png_of(image)); }

  std::unique_ptr<Film> film_of(const PictureSeries &series)
  {
    tell_file(series.name + ".ogv");
    tell_file(series.name + ".apng");
    return std::make_unique<Film>(folder_, series.name, request_.frames_per_second);
  }

  /// The largest swing as a picture, one cycle as a film that can be repeated.
  void mode(const PictureSeries &series, double times, double most)
  {
    const Parts       parts = read_parts(series.frames.front());
    const std::string words = caption(series, series.frames.front(), parts, times);
    tell(series, 0.);
    write(series.name + ".png", renderer_.draw(parts, times, most, words, Renderer::Sizes::unknown));
    tell_file(series.name + ".png");
    if (!request_.films)
      return;
    const auto    film         = film_of(series);
    constexpr int swing_frames = 24; // of a swing: 15 degrees of its phase each
    for (int k = 0; k < swing_frames; ++k)
      film->add(
          renderer_.draw(parts, times * std::sin(2. * M_PI * k / swing_frames), most, words, Renderer::Sizes::unknown));
    film->end();
  }

  void motion(const PictureSeries &series, double times, double most)
  {
    const bool            one = series.frames.size() == 1;
    std::unique_ptr<Film> film;
    if (!one && request_.films)
      film = film_of(series);
    for (std::size_t k = 0; k < series.frames.size(); ++k)
    {
      if (!one && !request_.films) // its pictures are the frames of the film
        break;
      const PictureFrame &frame = series.frames[k];
      const Parts         parts = read_parts(frame);
      tell(series, static_cast<double>(k) / static_cast<double>(series.frames.size()));
      const auto image =
          renderer_.draw(parts, times, most, caption(series, frame, parts, times), Renderer::Sizes::known);
      char digits[32];
      std::snprintf(digits, sizeof digits, "%05zu", k);
      write(one ? series.name + ".png" : series.name + '/' + series.name + "_" + digits + ".png", image);
      if (one)
        tell_file(series.name + ".png");
      if (film)
        film->add(image);
    }
    if (film)
    {
      film->end();
      tell_file(series.name + "/*.png");
    }
  }

  void tell(const PictureSeries &series, double share) const
  {
    if (request_.progress)
      request_.progress("drawing " + series.name, done_ + share / static_cast<double>(request_.series.size()));
  }

  const PictureRequest    &request_;
  OwnFolder                folder_;
  Renderer                 renderer_;
  std::vector<std::string> files_;
  double                   done_ = 0.;
};

} // namespace

} // namespace gestell::apps

extern "C" __attribute__((visibility("default"))) std::vector<std::string>
gestell_draw_pictures(const gestell::apps::PictureRequest &request)
{
  gestell::apps::Drawing   drawing(request);
  std::vector<std::string> files;
  for (std::size_t i = 0; i < request.series.size(); ++i)
    for (const std::string &file :
         drawing.draw(request.series[i], static_cast<double>(i) / static_cast<double>(request.series.size())))
      files.push_back(file);
  return files;
}
