#include "image.h"

#include <png.h>

#include <bit>
#include <csetjmp>
#include <utility>

#include "failure.h"

namespace cli {
namespace {

void append(std::string& bytes, float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<char>(bits >> shift & 0xff));
}

// libpng's writer of one image. It leaves by longjmp: each call that may is alone in a function that keeps nothing.
class Png {
 public:
  Png() : writer_(png_create_write_struct(PNG_LIBPNG_VER_STRING, &message_, keep_message, ignore_warning)) {
    if (writer_ != nullptr) info_ = png_create_info_struct(writer_);
    if (info_ == nullptr) fail();
    png_set_write_fn(writer_, &bytes_, append_bytes, nullptr);
  }
  ~Png() { png_destroy_write_struct(&writer_, &info_); }
  Png(const Png&) = delete;
  Png& operator=(const Png&) = delete;

  void begin(int width, int height) {
    if (!try_begin(static_cast<png_uint_32>(width), static_cast<png_uint_32>(height))) fail();
  }
  void write_row(const std::uint8_t* rgba) {
    if (!try_row(rgba)) fail();
  }
  std::string take() {
    if (!try_end()) fail();
    return std::move(bytes_);
  }

 private:
  bool try_begin(png_uint_32 width, png_uint_32 height) {
    if (setjmp(png_jmpbuf(writer_)) != 0) return false;
    constexpr int bits = 8;
    png_set_IHDR(writer_, info_, width, height, bits, PNG_COLOR_TYPE_RGBA, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB(writer_, info_, PNG_sRGB_INTENT_PERCEPTUAL);
    png_write_info(writer_, info_);
    return true;
  }
  bool try_row(const std::uint8_t* rgba) {
    if (setjmp(png_jmpbuf(writer_)) != 0) return false;
    png_write_row(writer_, rgba);
    return true;
  }
  bool try_end() {
    if (setjmp(png_jmpbuf(writer_)) != 0) return false;
    png_write_end(writer_, info_);
    return true;
  }

  static void append_bytes(png_structp writer, png_bytep bytes, std::size_t count) {
    static_cast<std::string*>(png_get_io_ptr(writer))->append(reinterpret_cast<const char*>(bytes), count);
  }
  static void keep_message(png_structp writer, png_const_charp message) {
    static_cast<std::string*>(png_get_error_ptr(writer))->assign(message);
    png_longjmp(writer, 1);
  }
  static void ignore_warning(png_structp /*writer*/, png_const_charp /*message*/) {}
  [[noreturn]] void fail() const { throw Failure(Exit::Computing, "the picture is no PNG: " + message_ + "."); }

  std::string message_ = "no memory is left", bytes_;
  png_structp writer_;
  png_infop info_ = nullptr;
};

}  // namespace

std::string png_of(const std::vector<std::uint8_t>& rgba, int width, int height,
                   const std::function<void(double)>& tell) {
  Png png;
  png.begin(width, height);
  const std::size_t stride = std::size_t{4} * static_cast<std::size_t>(width);
  constexpr int rows_between = 32;
  for (int row = 0; row < height; ++row) {
    if (row % rows_between == 0) tell(static_cast<double>(row) / height);
    png.write_row(rgba.data() + stride * static_cast<std::size_t>(row));
  }
  tell(1);
  return png.take();
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
