#pragma once

#include <string>
#include <string_view>

namespace files {

/// Throws std::runtime_error if the header of a NetCDF file in a classic format (CDF-1, CDF-2, CDF-5)
/// announces more than the file has. libnetcdf takes what is missing as zeros: numbers of a truncated file,
/// and a header as long as a damaged count says.
void check_classic_netcdf(std::string_view file, const std::string& name);

}  // namespace files
