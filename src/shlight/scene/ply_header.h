#pragma once

#include <iosfwd>
#include <string_view>

namespace shlight {

// Checks the header of a PLY file: assimp's reader hangs on headers it does not understand, and of triangle strips it
// keeps only the last triangle. Throws Error "subject: what is wrong: what would have been accepted" unless the header
// is one of PLY 1.0 with polygons. Reads up to the header's end.
void check_ply_header(std::istream& file, std::string_view subject);

}  // namespace shlight
