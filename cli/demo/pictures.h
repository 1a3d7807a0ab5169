// The demo's pictures: each is a PNG as bytes.
#pragma once

#include <string>

#include "demo/study.h"

namespace demo {

std::string coast_picture(const Study& study);
std::string levels_picture(const Study& study);
std::string details_picture(const Study& study);
std::string scalogram_picture(const Study& study);
std::string errors_picture(const Study& study);

}  // namespace demo
