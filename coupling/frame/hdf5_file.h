#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <string>
#include <vector>

namespace gestell::coupling
{

/**
 * A small HDF5 file of named arrays and strings: a new one, in memory until its image() is written, or an existing one
 * for reading; names may be paths ("outputs/0/on_q").
 *
 * HDF5 never writes to a disk, since it crashes on a full one. It does not lock files, which some network drives do not
 * support; writers use their own file names. Sizes of arrays are checked against the file size before allocation.
 * HDF5's messages on standard error are silenced; every failure is thrown as std::runtime_error with file and array.
 */
class Hdf5File
{
public:
  Hdf5File();                                 ///< new, in memory
  explicit Hdf5File(const std::string &file); ///< for reading
  ~Hdf5File();
  Hdf5File(const Hdf5File &)            = delete;
  Hdf5File &operator=(const Hdf5File &) = delete;

  /// The bytes of a new file.
  std::string image() const;

  bool has(const std::string &name) const;

  void write(const std::string &name, const Eigen::MatrixXd &A);
  void write(const std::string &name, const Eigen::MatrixXf &A);
  void write(const std::string &name, const Eigen::MatrixXi &A);
  void write(const std::string &name, const std::string &text);

  Eigen::MatrixXd read_matrix(const std::string &name) const;
  Eigen::VectorXd read_vector(const std::string &name) const; ///< a matrix of one column
  Eigen::MatrixXf read_floats(const std::string &name) const;
  Eigen::MatrixXi read_integers(const std::string &name) const;
  std::string     read_text(const std::string &name) const;
  double          read_number(const std::string &name) const;

private:
  template <typename Matrix>
  void write_array(const std::string &name, const Matrix &A, std::int64_t type);
  template <typename Matrix>
  Matrix read_array(const std::string &name, std::int64_t type, int type_class) const;

  std::string   file_;
  std::int64_t  handle_ = -1;
  std::uint64_t bytes_  = 0; ///< size of a file opened for reading
};

} // namespace gestell::coupling
