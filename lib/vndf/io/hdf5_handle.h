// HDF5 is a C library. This file closes its objects when they go out of scope and turns its error
// codes into FormatError.
#pragma once

#include <hdf5.h>

#include <string>
#include <utility>

#include "vndf/io/format_error.h"

namespace vndf::io {

/// Throws FormatError if an HDF5 call returned failure; `action` completes "HDF5 cannot ...".
template <class Result>
Result hdf5_checked(Result result, const std::string& action) {
  if (result < 0) throw FormatError("HDF5 cannot " + action, "build the table again");
  return result;
}

/// An identifier, closed with this object.
class Hdf5Handle {
 public:
  using Close = herr_t (*)(hid_t);

  Hdf5Handle(hid_t id, Close close, const std::string& action)
      : id_(hdf5_checked(id, action)), close_(close) {}
  ~Hdf5Handle() {
    if (id_ >= 0) close_(id_);
  }
  Hdf5Handle(Hdf5Handle&& other) noexcept
      : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}
  Hdf5Handle& operator=(Hdf5Handle&&) = delete;

  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  Close close_;
};

/// While it lives, HDF5 prints no errors; then it does as the host program set it to.
class Hdf5Quiet {
 public:
  Hdf5Quiet() {
    H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~Hdf5Quiet() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }
  Hdf5Quiet(const Hdf5Quiet&) = delete;
  Hdf5Quiet& operator=(const Hdf5Quiet&) = delete;

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

}  // namespace vndf::io
