#include "apps/output/exchange/zip_file.h"

#include <algorithm>
#include <cerrno>
#include <stdexcept>

#ifdef GESTELL_MINIZIP
#include <minizip/zip.h>
#endif

namespace gestell::apps
{

#ifdef GESTELL_MINIZIP
namespace
{

[[noreturn]] void fail_archive(const std::string &path)
{
  throw coupling::WriteFailure(path, std::error_code(errno != 0 ? errno : EIO, std::generic_category()));
}

} // namespace

bool ZipFile::available()
{
  return true;
}

ZipFile::ZipFile(const std::filesystem::path &path)
    : place_(path.string()), zip_((errno = 0, zipOpen64(place_.place().c_str(), APPEND_STATUS_CREATE)))
{
  if (!zip_)
    fail_archive(place_.path());
}

ZipFile::~ZipFile()
{
  if (zip_)
    zipClose(zip_, nullptr);
}

void ZipFile::add(const std::string &name, const std::string &bytes)
{
  zip_fileinfo about{};
  about.tmz_date.tm_year      = 1980; // the earliest year in an archive, so that the bytes depend only on the contents
  about.tmz_date.tm_mday      = 1;
  constexpr std::size_t plain = 0xffffffff; // size from which an entry is one of zip64
  bool written = zipOpenNewFileInZip64(zip_, name.c_str(), &about, nullptr, 0, nullptr, 0, nullptr, Z_DEFLATED,
                                       Z_DEFAULT_COMPRESSION, bytes.size() >= plain) == ZIP_OK;
  constexpr std::size_t piece = std::size_t(1) << 30; // bytes that minizip takes at once, as an unsigned
  for (std::size_t at = 0; written && at < bytes.size(); at += piece)
    written = zipWriteInFileInZip(zip_, bytes.data() + at, unsigned(std::min(piece, bytes.size() - at))) == ZIP_OK;
  if (!written || zipCloseFileInZip(zip_) != ZIP_OK)
    fail_archive(place_.path());
}

void ZipFile::finish()
{
  const bool closed = zipClose(zip_, nullptr) == ZIP_OK;
  zip_              = nullptr;
  if (!closed)
    fail_archive(place_.path());
  place_.finish();
}
#else
bool ZipFile::available()
{
  return false;
}

ZipFile::ZipFile(const std::filesystem::path &path) : place_(path.string())
{
  throw std::runtime_error("this build has no minizip, which writes archives: install libminizip-dev and build again");
}

ZipFile::~ZipFile() = default;
void ZipFile::add(const std::string &, const std::string &) {}
void ZipFile::finish() {}
#endif

} // namespace gestell::apps
