// HDF5, below netCDF, and threads.
#pragma once

#include <hdf5.h>

#include <mutex>

namespace raytube {

/// While it lives, no other thread of ours is in HDF5, which is not made for several at once. netCDF asks HDF5 for attributes
/// that may be missing, and keeps HDF5 from printing each as a failure in the first thread that opened a file only: here it is
/// any. That lasts, as others in the process (netCDF4 of Python) rely on what netCDF did.
class Hdf5InUse {
 public:
  Hdf5InUse() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }
  ~Hdf5InUse() = default;
  Hdf5InUse(const Hdf5InUse&) = delete;
  Hdf5InUse& operator=(const Hdf5InUse&) = delete;

 private:
  inline static std::mutex mutex;
  const std::lock_guard<std::mutex> lock_{mutex};
};

}  // namespace raytube
