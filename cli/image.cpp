#include "image.h"

#include <png.h>

#include <bit>
#include <cstring>

#include "failure.h"

namespace cli {
namespace {

void append(std::string& bytes, float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<char>(bits >> shift & 0xff));
}

}  // namespace

std::string png_of(const std::vector<std::uint8_t>& rgba, int width, int height) {
  png_image image;
  std::memset(&image, 0, sizeof image);
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width), image.height = static_cast<png_uint_32>(height);
  image.format = PNG_FORMAT_RGBA;
  const auto fail = [&] {
    throw Failure(Exit::Computing, std::string("the picture is no PNG: ") + image.message + ".");
  };
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);  // more than it takes
  std::string bytes(size, '\0');
  if (png_image_write_to_memory(&image, bytes.data(), &size, 0, rgba.data(), 0, nullptr) == 0) fail();
  bytes.resize(size);
  return bytes;
}

std::string ply_of(const std::vector<double>& points, int dimension, const std::vector<std::int32_t>& numbers,
                   const std::string& comment) {
  std::string bytes = "ply\nformat binary_little_endian 1.0\ncomment " + comment + "\nelement vertex " +
                      std::to_string(numbers.size()) +
                      "\nproperty float x\nproperty float y\nproperty float z\nproperty uchar symbol\nend_header\n";
  bytes.reserve(bytes.size() + numbers.size() * 13);
  const double* point = points.data();
  for (const std::int32_t number : numbers) {
    for (int axis = 0; axis < 3; ++axis) append(bytes, axis < dimension ? static_cast<float>(point[axis]) : 0.0F);
    bytes.push_back(static_cast<char>(number));
    point += dimension;
  }
  return bytes;
}

}  // namespace cli
