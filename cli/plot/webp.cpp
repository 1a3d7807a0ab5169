#include "webp.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <webp/encode.h>
#include <webp/mux.h>

namespace plot {
namespace {

void check(int fine, const char* what) {
  if (!fine) throw std::runtime_error(std::string("libwebp ") + what + ".");
}

}  // namespace

struct Animation::Encoder {
  WebPAnimEncoder* encoder;
};

void Animation::Release::operator()(Encoder* encoder) const {
  WebPAnimEncoderDelete(encoder->encoder);
  delete encoder;
}

Animation::Animation(int width, int height) : width_(width), height_(height) {
  WebPAnimEncoderOptions options;
  check(WebPAnimEncoderOptionsInit(&options), "is of another version");
  options.minimize_size = 1;
  auto* const made = WebPAnimEncoderNew(width, height, &options);
  check(made != nullptr, "makes no animation of that size");
  encoder_.reset(new Encoder{made});
}

void Animation::add(const Pixels& frame, double until) {
  WebPConfig config;
  WebPPicture picture;
  check(WebPConfigInit(&config) && WebPConfigLosslessPreset(&config, 6) && WebPPictureInit(&picture),
        "is of another version");
  picture.use_argb = 1;
  picture.width = width_, picture.height = height_;
  // Borrowed: the encoder reads it during the call.
  picture.argb = const_cast<std::uint32_t*>(frame.values.data());
  picture.argb_stride = width_;
  check(WebPAnimEncoderAdd(encoder_->encoder, &picture, now_, &config), "cannot encode a frame");
  now_ = std::max(now_ + 1, static_cast<int>(std::lround(1000 * until)));
}

std::string Animation::bytes() {
  WebPData data;
  WebPDataInit(&data);
  check(WebPAnimEncoderAdd(encoder_->encoder, nullptr, now_, nullptr), "cannot end the animation");
  check(WebPAnimEncoderAssemble(encoder_->encoder, &data), "cannot put the animation together");
  std::string all(reinterpret_cast<const char*>(data.bytes), data.size);
  WebPDataClear(&data);
  return all;
}

}  // namespace plot
