#pragma once

#include "coupling/frame/atomic_file.h"

#include <Eigen/Core>

#include <filesystem>
#include <string>
#include <vector>

namespace gestell::apps
{

/// A file of MATLAB in version 5, which NumPy (scipy.io), Octave and Julia read as well.  It is written to a temporary
/// file beside its place and renamed by finish(), so that it appears whole or not at all.
class MatFile
{
public:
  static bool available(); ///< built with libmatio

  /// @throws coupling::WriteFailure if it cannot be written, as the others
  MatFile(const std::filesystem::path &path, const std::string &title);
  ~MatFile();
  MatFile(const MatFile &) = delete;

  void add(const std::string &name, const Eigen::MatrixXd &matrix);
  void add(const std::string &name, const std::vector<std::string> &texts); ///< a column of cells
  void finish();                                                            ///< @throws coupling::WriteFailure

private:
  coupling::FileBeside place_;
  void                *file_ = nullptr;
};

} // namespace gestell::apps
