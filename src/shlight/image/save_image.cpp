#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <cmath>

#include "shlight/core/file.h"
#include "shlight/image/image_io.h"
#include "shlight/image/picture_reader.h"
#include "shlight/image/rgbe.h"

namespace shlight {
namespace {

constexpr float kLargestHalf = 65504;

void encode(const std::filesystem::path& path, OIIO::ImageSpec spec, OIIO::TypeDesc type, const void* values,
            const char* accepted) {
  without_library_threads();
  const std::string name = path.string();
  auto output = OIIO::ImageOutput::create(name);
  if (!output || !output->supports("ioproxy"))
    throw Error(name, fmt::format("cannot write '{}' pictures", path.extension().string()), accepted);
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  output->set_ioproxy(&memory);
  if (!output->open(name, spec) || !output->write_image(type, values) || !output->close())
    throw Error(name, "cannot be encoded (" + output->geterror() + ")", accepted);
  write_file(path, std::as_bytes(std::span(bytes)));
}

}  // namespace

void save_image(const std::filesystem::path& path, const Image& image, std::optional<Layout> layout) {
  if (has_ending(path.string(), {".hdr"})) return write_file(path, encode_rgbe(image, path.string()));
  OIIO::ImageSpec spec(image.width, image.height, 3, OIIO::TypeDesc::HALF);
  // Half floats are what everybody reads, but a sun does not fit into them.
  for (const float value : image.values)
    if (std::abs(value) > kLargestHalf) spec.set_format(OIIO::TypeDesc::FLOAT);
  spec.attribute("compression", "zip");
  spec.attribute("oiio:ColorSpace", "Linear");
  // OpenImageIO's names of OpenEXR's envmap attribute.
  if (layout == Layout::kOpenExrLatLong) spec.attribute("textureformat", "LatLong Environment");
  if (layout == Layout::kOpenExrCube) spec.attribute("textureformat", "CubeFace Environment");
  encode(path, spec, OIIO::TypeFloat, image.values.data(), "a file name that ends in .exr or .hdr");
}

void save_image8(const std::filesystem::path& path, const Image8& image) {
  OIIO::ImageSpec spec(image.width, image.height, 4, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  spec.attribute("oiio:UnassociatedAlpha", 1);
  encode(path, spec, OIIO::TypeDesc::UINT8, image.values.data(), "a file name that ends in .png");
}

}  // namespace shlight
