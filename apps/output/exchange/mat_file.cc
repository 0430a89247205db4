#include "apps/output/exchange/mat_file.h"

#include <cerrno>
#include <stdexcept>

#ifdef GESTELL_MATIO
#include <matio.h>
#endif

namespace gestell::apps
{

#ifdef GESTELL_MATIO

namespace
{

[[noreturn]] void fail_matrices(const std::string &path)
{
  throw coupling::WriteFailure(path, std::error_code(errno != 0 ? errno : EIO, std::generic_category()));
}

/// Takes the variable, whose numbers were copied by Mat_VarCreate().
void write(void *file, matvar_t *variable, const std::string &path)
{
  const bool written = variable && Mat_VarWrite(static_cast<mat_t *>(file), variable, MAT_COMPRESSION_NONE) == 0;
  Mat_VarFree(variable);
  if (!written)
    fail_matrices(path);
}

matvar_t *text_variable(const std::string &text)
{
  std::size_t size[] = {text.empty() ? 0u : 1u, text.size()};
  return Mat_VarCreate(nullptr, MAT_C_CHAR, MAT_T_UTF8, 2, size, const_cast<char *>(text.data()), 0);
}

} // namespace

bool MatFile::available()
{
  return true;
}

MatFile::MatFile(const std::filesystem::path &path, const std::string &title)
    : place_(path.string()), file_((errno = 0, Mat_CreateVer(place_.place().c_str(), title.c_str(), MAT_FT_MAT5)))
{
  if (!file_)
    fail_matrices(place_.path());
}

MatFile::~MatFile()
{
  if (file_)
    Mat_Close(static_cast<mat_t *>(file_));
}

void MatFile::finish()
{
  const bool closed = Mat_Close(static_cast<mat_t *>(file_)) == 0;
  file_             = nullptr;
  if (!closed)
    fail_matrices(place_.path());
  place_.finish();
}

void MatFile::add(const std::string &name, const Eigen::MatrixXd &matrix)
{
  std::size_t size[] = {std::size_t(matrix.rows()), std::size_t(matrix.cols())};
  write(file_, Mat_VarCreate(name.c_str(), MAT_C_DOUBLE, MAT_T_DOUBLE, 2, size, const_cast<double *>(matrix.data()), 0),
        place_.path());
}

void MatFile::add(const std::string &name, const std::vector<std::string> &texts)
{
  std::size_t             size[] = {texts.size(), 1};
  std::vector<matvar_t *> cells;
  for (const std::string &text : texts)
    cells.push_back(text_variable(text));
  write(file_, Mat_VarCreate(name.c_str(), MAT_C_CELL, MAT_T_CELL, 2, size, cells.data(), 0), place_.path());
}

#else

bool MatFile::available()
{
  return false;
}

MatFile::MatFile(const std::filesystem::path &path, const std::string &) : place_(path.string())
{
  throw std::invalid_argument("--export mat: this build has no libmatio; install libmatio-dev and build again, or use "
                              "matrix-market");
}

MatFile::~MatFile() = default;

void MatFile::finish() {}
void MatFile::add(const std::string &, const Eigen::MatrixXd &) {}
void MatFile::add(const std::string &, const std::vector<std::string> &) {}

#endif

} // namespace gestell::apps
