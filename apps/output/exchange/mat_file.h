#pragma once

#include "coupling/frame/atomic_file.h"

#include <Eigen/Core>

#include <filesystem>
#include <string>
#include <vector>

namespace gestell::apps
{

/// A MAT-file of version 5 (MATLAB), which NumPy (scipy.io), Octave and Julia also read.  It is written to a temporary
/// file in the same folder and renamed by finish(), so that it appears complete or not at all.
class MatFile
{
public:
  static bool available(); ///< built with libmatio

  /// @throws coupling::WriteFailure if the file cannot be written, as do the other functions
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
