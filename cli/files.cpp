#include "files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <deque>
#include <filesystem>
#include <mutex>
#include <set>
#include <system_error>

#include "destination.h"
#include "failure.h"

namespace cli {
namespace {

namespace fs = std::filesystem;

std::string reason(int error) { return std::system_category().message(error); }

[[noreturn]] void fail_input(const std::string& path, const std::string& what) {
  throw Failure(Exit::Input, input_name(path) + " " + what + ".");
}

[[noreturn]] void fail_output(const std::string& path, const std::string& what) {
  throw Failure(Exit::Output, output_name(path) + " cannot be written: " + what + ".");
}

class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() { close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int number() const { return number_; }
  bool valid() const { return number_ >= 0; }
  // 0, or the error that only closing brings to light (full quotas, network disks).
  int close() {
    if (!valid()) return 0;
    const int failed = ::close(number_);
    number_ = -1;
    return failed == 0 ? 0 : errno;
  }

 private:
  int number_;
};

std::string read_all(int descriptor, const std::string& path) {
  std::string bytes;
  for (std::array<char, 1 << 16> chunk;;) {
    const ssize_t count = ::read(descriptor, chunk.data(), chunk.size());
    if (count == 0) return bytes;
    if (count > 0)
      bytes.append(chunk.data(), static_cast<std::size_t>(count));
    else if (errno == EISDIR)
      fail_input(path, "is a directory; name a file");
    else if (errno != EINTR)
      fail_input(path, "cannot be read: " + reason(errno));
  }
}

// 0 or the error.
int write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(descriptor, bytes.data(), bytes.size());
    if (count >= 0)
      bytes.remove_prefix(static_cast<std::size_t>(count));
    else if (errno != EINTR)
      return errno;
  }
  return 0;
}

bool is_special(const fs::path& path) {
  std::error_code ignored;
  const auto status = fs::status(path, ignored);
  return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

fs::path folder_of(const fs::path& path) { return path.has_parent_path() ? path.parent_path() : fs::path("."); }

// What a file made by open() would get, or what the file to be replaced has.
mode_t mode_for(const fs::path& target) {
  struct stat existing;
  if (::stat(target.c_str(), &existing) == 0) return existing.st_mode & 07777;
  const mode_t mask = ::umask(0);
  ::umask(mask);
  return 0666 & ~mask;
}

std::mutex writing;                // held while what follows changes
std::set<std::string> unfinished;  // new files that no rename has made whole yet
Written written = Written::Nothing;

void now_written(Written more) {
  const std::lock_guard lock(writing);
  written = std::max(written, more);
}

constexpr const char* in_the_way = "it is there already; remove it, choose another name, or add --overwrite";

// Gives a file another name; 0 or the error. Refuses to replace in one step where the file system can.
int renamed(const fs::path& from, const fs::path& to, Existing existing) {
  if (existing == Existing::Refused) {
    if (::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) return 0;
    if (errno != EINVAL && errno != ENOSYS) return errno;
    if (::access(to.c_str(), F_OK) == 0) return EEXIST;
  }
  return ::rename(from.c_str(), to.c_str()) == 0 ? 0 : errno;
}

class NewFile {
 public:
  explicit NewFile(std::string path)
      : path_(std::move(path)),
        target_(destination(path_).path),
        name_((folder_of(target_) / ".ifsm-XXXXXX").string()),
        descriptor_(create()) {
    if (!descriptor_.valid()) fail_output(path_, reason(errno));
  }
  ~NewFile() {
    const std::lock_guard lock(writing);
    if (unfinished.erase(name_) > 0) ::unlink(name_.c_str());
  }
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;

  void fill(std::string_view bytes) {
    int error = write_all(descriptor_.number(), bytes);
    if (error == 0 && ::fchmod(descriptor_.number(), mode_for(target_)) != 0) error = errno;
    if (error == 0 && ::fsync(descriptor_.number()) != 0) error = errno;
    if (error == 0) error = descriptor_.close();
    if (error != 0) fail_output(path_, reason(error));
  }

  // The caller holds `writing`.
  void take_its_name(Existing existing) {
    const int error = renamed(name_, target_, existing);
    if (error != 0) fail_output(path_, error == EEXIST ? in_the_way : reason(error));
    unfinished.erase(name_);
  }
  void remove_again() const { ::unlink(target_.c_str()); }

 private:
  int create() {
    const std::lock_guard lock(writing);
    const int descriptor = ::mkostemp(name_.data(), O_CLOEXEC);
    if (descriptor >= 0) unfinished.insert(name_);
    return descriptor;
  }

  std::string path_;
  fs::path target_;
  std::string name_;
  Descriptor descriptor_;
};

void place(std::deque<NewFile>& files, Existing existing) {
  const std::lock_guard lock(writing);
  written = Written::All;  // from here on nobody stops it
  auto next = files.begin();
  try {
    for (; next != files.end(); ++next) next->take_its_name(existing);
  } catch (const Failure&) {
    if (existing == Existing::Refused)
      for (auto placed = files.begin(); placed != next; ++placed) placed->remove_again();
    throw;
  }
}

bool is_written_to_directly(const Destination& target) { return target.descriptor || is_special(target.path); }

void write_directly(const std::string& path, const Destination& target, std::string_view bytes) {
  now_written(Written::Part);
  Descriptor file(target.descriptor ? ::dup(*target.descriptor) : ::open(target.path.c_str(), O_WRONLY | O_CLOEXEC));
  const int error = file.valid() ? write_all(file.number(), bytes) : errno;
  const int late = file.close();
  if (error != 0 || late != 0) fail_output(path, reason(error != 0 ? error : late));
}

// 0, or why nothing can be written to an open descriptor.
int check_descriptor(int descriptor) {
  const int flags = ::fcntl(descriptor, F_GETFL);
  if (flags < 0) return errno;
  return (flags & O_ACCMODE) == O_RDONLY ? EBADF : 0;
}

void check_folder(const std::string& path, const fs::path& folder) {
  struct stat found;
  if (::stat(folder.c_str(), &found) != 0) fail_output(path, folder.string() + ": " + reason(errno));
  if (!S_ISDIR(found.st_mode)) fail_output(path, folder.string() + " is not a directory");
  if (::access(folder.c_str(), W_OK | X_OK) != 0) fail_output(path, folder.string() + ": " + reason(errno));
}

}  // namespace

std::string input_name(const std::string& path) {
  return path == "-" ? "standard input" : path.empty() ? "'' (an empty name)" : path;
}
std::string output_name(const std::string& path) { return path == "-" ? "standard output" : path; }

bool goes_to_standard_output(const std::string& path) {
  const auto descriptor = destination(path).descriptor;
  struct stat target, standard;
  return descriptor &&
         (*descriptor == STDOUT_FILENO || (::fstat(*descriptor, &target) == 0 &&
                                           ::fstat(STDOUT_FILENO, &standard) == 0 && same_file(target, standard)));
}

std::string read_file(const std::string& path) {
  if (path == "-") return read_all(STDIN_FILENO, path);
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (!file.valid()) fail_input(path, "cannot be opened: " + reason(errno));
  return read_all(file.number(), path);
}

void check_writable(const std::string& path) {
  if (path.empty()) throw Failure(Exit::Usage, "-o '' names no file; give a name, or - for standard output.");
  const auto target = destination(path);
  if (target.error != 0) fail_output(path, reason(target.error));
  if (target.descriptor) {
    if (const int error = check_descriptor(*target.descriptor); error != 0) fail_output(path, reason(error));
  } else if (is_special(target.path)) {
    if (::access(target.path.c_str(), W_OK) != 0) fail_output(path, reason(errno));
  } else {
    std::error_code ignored;
    if (fs::is_directory(target.path, ignored)) fail_output(path, "it is a directory; name a file in it");
    check_folder(path, folder_of(target.path));
  }
}

void check_absent(const std::string& path, Existing existing) {
  struct stat found;
  if (existing == Existing::Refused && !is_written_to_directly(destination(path)) && ::lstat(path.c_str(), &found) == 0)
    fail_output(path, in_the_way);
}

void check_not_read(const std::string& output, const std::vector<std::string>& inputs, const char* option) {
  const auto target = destination(output);
  struct stat written_to, read_from;
  if (target.descriptor || ::stat(target.path.c_str(), &written_to) != 0 || !S_ISREG(written_to.st_mode)) return;
  for (const auto& input : inputs) {
    const int failed = input == "-" ? ::fstat(STDIN_FILENO, &read_from) : ::stat(input.c_str(), &read_from);
    if (failed == 0 && same_file(written_to, read_from))
      throw Failure(Exit::Usage, option + (" " + output) + " is the file that is read" +
                                     (input == output ? "" : " (" + input_name(input) + ")") +
                                     ", and would be replaced; name another file.");
  }
}

void write_file(const std::string& path, std::string_view bytes) {
  check_writable(path);
  if (const auto target = destination(path); is_written_to_directly(target)) {
    write_directly(path, target, bytes);
    return now_written(Written::All);
  }
  std::deque<NewFile> one;
  one.emplace_back(path).fill(bytes);
  place(one, Existing::Replaced);
}

void write_files(const std::vector<File>& files, Existing existing) {
  std::deque<NewFile> whole;
  for (const auto& [path, bytes] : files) {
    check_writable(path);
    check_absent(path, existing);
    if (const auto target = destination(path); is_written_to_directly(target))
      write_directly(path, target, bytes);
    else
      whole.emplace_back(path).fill(bytes);
  }
  place(whole, existing);
}

Written abandon_writing() {
  writing.lock();
  if (written == Written::All) {
    writing.unlock();
  } else {
    for (const auto& name : unfinished) ::unlink(name.c_str());  // the lock stays for ever: the process ends
  }
  return written;
}

}  // namespace cli
