#pragma once

#include <string>
#include <vector>

#include "shlight/image/image.h"
#include "shlight/truth/plane.h"

namespace shlight {

// A column of a comparison: a picture and what stands under it, line by line.
struct ComparedPicture {
  Image8 picture;
  std::vector<std::string> lines;
};

// Pictures side by side, tops aligned, on a dark page, each with its lines under it (picture_text.h has the
// characters); a line longer than its picture is cut. At least one picture.
Image8 make_comparison(const std::vector<ComparedPicture>& pictures);

}  // namespace shlight
