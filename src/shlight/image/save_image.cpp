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

// `file_name` tells the format by its ending; `name` is what errors are about.
std::vector<std::byte> encode(const std::string& name, const std::string& file_name, OIIO::ImageSpec spec,
                              OIIO::TypeDesc type, const void* values, const char* accepted) {
  without_library_threads();
  auto output = OIIO::ImageOutput::create(file_name);
  if (!output || !output->supports("ioproxy"))
    throw Error(name, fmt::format("cannot write '{}' pictures", std::filesystem::path(file_name).extension().string()),
                accepted);
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  output->set_ioproxy(&memory);
  if (!output->open(name, spec) || !output->write_image(type, values) || !output->close())
    throw Error(name, "cannot be encoded (" + output->geterror() + ")", accepted);
  const std::span<const std::byte> encoded = std::as_bytes(std::span(bytes));
  return {encoded.begin(), encoded.end()};
}

std::vector<std::byte> encode8(const Image8& image, const std::string& name, const std::string& file_name) {
  OIIO::ImageSpec spec(image.width, image.height, 4, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  spec.attribute("oiio:UnassociatedAlpha", 1);
  return encode(name, file_name, spec, OIIO::TypeDesc::UINT8, image.values.data(), "a file name that ends in .png");
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
  write_file(path, encode(path.string(), path.string(), spec, OIIO::TypeFloat, image.values.data(),
                          "a file name that ends in .exr or .hdr"));
}

void save_image8(const std::filesystem::path& path, const Image8& image) {
  write_file(path, encode8(image, path.string(), path.string()));
}

std::vector<std::byte> encode_png(const Image8& image, const std::string& name) {
  return encode8(image, name, "texture.png");
}

}  // namespace shlight
