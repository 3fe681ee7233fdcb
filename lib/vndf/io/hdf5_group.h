// The links of an HDF5 group of the oldest layout: names and where their objects are.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "vndf/io/hdf5_object.h"

namespace vndf::io {

/// The addresses of the objects with one of `names` in a group. Links of other names are passed
/// over. Throws FormatError where the group is of a newer layout or a link is soft or there twice.
std::map<std::string, std::uint64_t> hdf5_links(UntrustedFile& file, const Hdf5Object& group,
                                                const std::vector<std::string>& names);

}  // namespace vndf::io
