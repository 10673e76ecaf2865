#pragma once

#include <filesystem>

#include "shlight/image/image.h"
#include "shlight/image/layout.h"

namespace shlight {

// The layout of a picture whose file states none, told from its shape and, where that leaves a choice, from the words
// of its name: that of a layout, "probe" or "angular", "mirror" or "ball", "octa". Throws Error, which names the
// candidates, where that tells none or several: a square without such a word, a picture of 4:3 whose corners are not
// plain, as a cross's are.
Layout recognise_layout(const std::filesystem::path& path, const Image& image);

}  // namespace shlight
