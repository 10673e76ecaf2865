#pragma once

#include <iosfwd>
#include <string_view>

namespace shlight {

// Checks the header of a PLY file: assimp's reader hangs on headers it does not understand, and of triangle strips it
// keeps only the last triangle, and it takes memory for as many elements as are promised. Throws Error "subject: what
// is wrong: what would have been accepted" unless the header is one of PLY 1.0 with polygons and at least as many bytes
// follow as it promises. Reads up to the header's end; the file can be sought in.
void check_ply_header(std::istream& file, std::string_view subject);

}  // namespace shlight
