#include "fit/quiet.h"

#include <glog/logging.h>

#include <mutex>

namespace ifsm::core {
namespace {

// glog's level belongs to the process: it is raised while any fit runs and put back after the last.
struct Level {
  std::mutex mutex;
  int running = 0;
  int before = 0;
};

Level& level() {
  static Level the_level;
  return the_level;
}

}  // namespace

Quiet::Quiet() {
  const std::lock_guard lock(level().mutex);
  if (level().running++ > 0) return;
  level().before = FLAGS_minloglevel;
  FLAGS_minloglevel = google::GLOG_FATAL;
}

Quiet::~Quiet() {
  const std::lock_guard lock(level().mutex);
  if (--level().running == 0) FLAGS_minloglevel = level().before;
}

}  // namespace ifsm::core
