#include "coupling/frame/hdf5_file.h"

#include "coupling/integration/system/announced_size.h"

#include <hdf5.h>

#include <stdexcept>

namespace gestell::coupling
{

namespace
{

/// An HDF5 identifier that closes itself.
class Handle
{
public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Handle()
  {
    if (id_ >= 0)
      close_(id_);
  }
  Handle(const Handle &)            = delete;
  Handle &operator=(const Handle &) = delete;
          operator hid_t() const { return id_; }

private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// During its lifetime HDF5 prints no messages.
class QuietErrors
{
public:
  QuietErrors()
  {
    H5Eget_auto2(H5E_DEFAULT, &print_, &to_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~QuietErrors() { H5Eset_auto2(H5E_DEFAULT, print_, to_); }

private:
  H5E_auto2_t print_;
  void       *to_;
};

[[noreturn]] void fail(const std::string &file, const std::string &what)
{
  throw std::runtime_error(file + ": " + what);
}

} // namespace

Hdf5File::Hdf5File() : file_("HDF5 in memory")
{
  const QuietErrors quiet;
  const Handle      access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_core(access, 1 << 20, false);
  handle_ = H5Fcreate(file_.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access);
  if (handle_ < 0)
    fail(file_, "cannot be created");
}

Hdf5File::Hdf5File(const std::string &file) : file_(file)
{
  const QuietErrors quiet;
  const Handle      access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_file_locking(access, false, true);
  handle_ = H5Fopen(file.c_str(), H5F_ACC_RDONLY, access);
  if (handle_ < 0)
    fail(file, "cannot be opened as HDF5");
  hsize_t bytes = 0;
  if (H5Fget_filesize(handle_, &bytes) < 0)
    fail(file, "has no size");
  bytes_ = bytes;
}

Hdf5File::~Hdf5File()
{
  const QuietErrors quiet;
  if (handle_ >= 0)
    H5Fclose(handle_);
}

std::string Hdf5File::image() const
{
  const QuietErrors quiet;
  const ssize_t     size = H5Fflush(handle_, H5F_SCOPE_GLOBAL) >= 0 ? H5Fget_file_image(handle_, nullptr, 0) : -1;
  std::string       bytes(size > 0 ? std::size_t(size) : 0, '\0');
  if (size <= 0 || H5Fget_file_image(handle_, bytes.data(), bytes.size()) != size)
    fail(file_, "cannot be assembled");
  return bytes;
}

bool Hdf5File::has(const std::string &name) const
{
  const QuietErrors quiet;
  return H5Oexists_by_name(handle_, name.c_str(), H5P_DEFAULT) > 0;
}

template <typename Matrix>
void Hdf5File::write_array(const std::string &name, const Matrix &A, std::int64_t type)
{
  const QuietErrors quiet;
  const hsize_t     size[2] = {hsize_t(A.cols()), hsize_t(A.rows())}; // column-major here, row-major there
  const Handle      space(H5Screate_simple(2, size, nullptr), H5Sclose);
  const Handle      groups(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(groups, 1);
  const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(creation, false); // equal input, equal file
  const Handle array(H5Dcreate2(handle_, name.c_str(), type, space, groups, creation, H5P_DEFAULT), H5Dclose);
  if (array < 0 || (A.size() > 0 && H5Dwrite(array, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, A.data()) < 0))
    fail(file_, "array '" + name + "' cannot be written");
}

template <typename Matrix>
Matrix Hdf5File::read_array(const std::string &name, std::int64_t type, int type_class) const
{
  const QuietErrors quiet;
  const Handle      array(H5Dopen2(handle_, name.c_str(), H5P_DEFAULT), H5Dclose);
  if (array < 0)
    fail(file_, "array '" + name + "' is missing");
  const Handle space(H5Dget_space(array), H5Sclose), stored(H5Dget_type(array), H5Tclose);
  hsize_t      size[2];
  if (H5Sget_simple_extent_ndims(space) != 2 || H5Sget_simple_extent_dims(space, size, nullptr) != 2 ||
      H5Tget_class(stored) != type_class)
    fail(file_, "array '" + name + "' is not a matrix of the type expected");
  // These arrays are neither compressed nor of a smaller number type: the file must contain every byte of them.
  if (!stand_in(bytes_, size[0], size[1], sizeof(typename Matrix::Scalar)))
    fail(file_, "array '" + name + "' claims a size that a file of " + std::to_string(bytes_) + " bytes cannot hold");
  Matrix A(size[1], size[0]);
  if (A.size() > 0 && H5Dread(array, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, A.data()) < 0)
    fail(file_, "array '" + name + "' cannot be read");
  return A;
}

void Hdf5File::write(const std::string &name, const Eigen::MatrixXd &A)
{
  write_array(name, A, H5T_NATIVE_DOUBLE);
}

void Hdf5File::write(const std::string &name, const Eigen::MatrixXf &A)
{
  write_array(name, A, H5T_NATIVE_FLOAT);
}

void Hdf5File::write(const std::string &name, const Eigen::MatrixXi &A)
{
  write_array(name, A, H5T_NATIVE_INT);
}

void Hdf5File::write(const std::string &name, const std::string &text)
{
  Eigen::Matrix<signed char, Eigen::Dynamic, Eigen::Dynamic> letters(text.size(), 1);
  std::copy(text.begin(), text.end(), letters.data());
  write_array(name, letters, H5T_NATIVE_SCHAR);
}

Eigen::MatrixXd Hdf5File::read_matrix(const std::string &name) const
{
  return read_array<Eigen::MatrixXd>(name, H5T_NATIVE_DOUBLE, H5T_FLOAT);
}

Eigen::VectorXd Hdf5File::read_vector(const std::string &name) const
{
  const Eigen::MatrixXd A = read_matrix(name);
  if (A.cols() != 1)
    fail(file_, "array '" + name + "' has " + std::to_string(A.cols()) + " columns; it must be a vector");
  return A;
}

Eigen::MatrixXf Hdf5File::read_floats(const std::string &name) const
{
  return read_array<Eigen::MatrixXf>(name, H5T_NATIVE_FLOAT, H5T_FLOAT);
}

Eigen::MatrixXi Hdf5File::read_integers(const std::string &name) const
{
  return read_array<Eigen::MatrixXi>(name, H5T_NATIVE_INT, H5T_INTEGER);
}

std::string Hdf5File::read_text(const std::string &name) const
{
  const auto letters =
      read_array<Eigen::Matrix<signed char, Eigen::Dynamic, Eigen::Dynamic>>(name, H5T_NATIVE_SCHAR, H5T_INTEGER);
  return std::string(letters.data(), letters.data() + letters.size());
}

double Hdf5File::read_number(const std::string &name) const
{
  const Eigen::MatrixXd A = read_matrix(name);
  if (A.size() != 1)
    fail(file_, "'" + name + "' must be one number");
  return A(0, 0);
}

} // namespace gestell::coupling
