// Files are replaced whole or not at all.
#include "files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <functional>

#include <gtest/gtest.h>

#include "failure.h"

namespace cli {
namespace {

namespace fs = std::filesystem;

class Files : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "ifsm-files-XXXXXX").string();
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string at(const std::string& name) const { return (folder_ / name).string(); }
  std::size_t count() const { return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), {})); }
  static Exit code_of(const std::function<void()>& action) {
    try {
      action();
      return Exit::Fine;
    } catch (const Failure& failure) {
      return failure.code;
    }
  }

  fs::path folder_;
};

TEST_F(Files, WhatIsWrittenIsReadAndNothingElseIsLeft) {
  const std::string bytes("a\0b\n", 4);
  write_file(at("x"), "before");
  write_file(at("x"), bytes);
  EXPECT_EQ(read_file(at("x")), bytes);
  EXPECT_EQ(count(), 1u);
}

TEST_F(Files, ASymbolicLinkStaysOne) {
  write_file(at("target"), "old");
  fs::create_symlink("target", at("link"));
  write_file(at("link"), "new");
  EXPECT_TRUE(fs::is_symlink(at("link")));
  EXPECT_EQ(read_file(at("target")), "new");
}

TEST_F(Files, ASymbolicLinkToNothingHasItsTargetMade) {
  fs::create_directory(at("folder"));
  fs::create_symlink("folder/target", at("second"));
  fs::create_symlink("second", at("first"));
  write_file(at("first"), "new");
  EXPECT_TRUE(fs::is_symlink(at("first")) && fs::is_symlink(at("second")));
  EXPECT_EQ(read_file(at("folder/target")), "new");
  EXPECT_EQ(count(), 3u);
}

TEST_F(Files, APathThatLeadsNowhereIsAnOutputFailure) {
  fs::create_symlink("loop", at("loop"));
  write_file(at("plain"), "");
  for (const auto& name : {std::string("loop"), std::string(300, 'x'), std::string("plain/x")}) {
    EXPECT_EQ(code_of([&] { check_writable(at(name)); }), Exit::Output) << name;
    EXPECT_EQ(code_of([&] { write_file(at(name), "1"); }), Exit::Output) << name;
    EXPECT_EQ(code_of([&] { write_files({{at(name), "1"}}, Existing::Refused); }), Exit::Output) << name;
  }
  EXPECT_EQ(code_of([] { check_writable(""); }), Exit::Usage);
  EXPECT_EQ(count(), 2u);
}

TEST_F(Files, ADescriptorIsWrittenToWhereItStands) {
  const int descriptor = ::open(at("log").c_str(), O_WRONLY | O_CREAT, 0644);
  ASSERT_EQ(::write(descriptor, "before ", 7), 7);
  for (const std::string folder : {"/dev/fd/", "/proc/self/fd/"}) {
    check_writable(folder + std::to_string(descriptor));
    write_file(folder + std::to_string(descriptor), "x ");
  }
  fs::create_symlink("/dev/fd/" + std::to_string(descriptor), at("link"));
  write_files({{at("link"), "y "}}, Existing::Refused);
  ASSERT_EQ(::write(descriptor, "after", 5), 5);
  ::close(descriptor);
  EXPECT_EQ(read_file(at("log")), "before x x y after");
  EXPECT_EQ(count(), 2u);
  EXPECT_EQ(code_of([&] { check_writable("/dev/fd/" + std::to_string(descriptor)); }), Exit::Output);
}

TEST_F(Files, AnInputIsNoOutputUnderWhateverName) {
  write_file(at("in"), "1");
  write_file(at("other"), "1");
  fs::create_symlink("in", at("link"));
  fs::create_hard_link(at("in"), at("same"));
  for (const std::string name : {"in", "link", "same", "./in"})
    EXPECT_EQ(code_of([&] { check_not_read(at(name), {at("other"), at("in")}); }), Exit::Usage) << name;
  EXPECT_EQ(code_of([&] { check_not_read(at("new"), {at("in"), ""}); }), Exit::Fine);
  EXPECT_EQ(code_of([&] { check_not_read(at("other"), {at("in"), "-"}); }), Exit::Fine);
  EXPECT_EQ(code_of([] { check_not_read("/dev/null", {"/dev/null"}); }), Exit::Fine);
}

TEST_F(Files, ANewFileHasTheUsualModeAndAReplacedOneKeepsItsOwn) {
  const mode_t mask = ::umask(022);
  write_file(at("new"), "");
  EXPECT_EQ(fs::status(at("new")).permissions(), fs::perms(0644));
  fs::permissions(at("new"), fs::perms(0600));
  write_file(at("new"), "again");
  EXPECT_EQ(fs::status(at("new")).permissions(), fs::perms(0600));
  ::umask(mask);
}

TEST_F(Files, WhatCannotBeWrittenIsKnownBeforehand) {
  EXPECT_EQ(code_of([&] { check_writable(folder_.string()); }), Exit::Output);
  EXPECT_EQ(code_of([&] { check_writable(at("missing/x")); }), Exit::Output);
  EXPECT_EQ(code_of([&] { check_writable(at("x")); }), Exit::Fine);
  EXPECT_EQ(count(), 0u);
}

TEST_F(Files, ADeviceIsWrittenToAndStaysADevice) {
  write_file("/dev/null", "gone");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  EXPECT_EQ(code_of([] { write_file("/dev/full", "no room"); }), Exit::Output);
}

TEST_F(Files, SeveralAreWrittenTogetherOrNotAtAll) {
  write_files({{at("a"), "1"}, {at("b"), "2"}}, Existing::Refused);
  EXPECT_EQ(read_file(at("a")) + read_file(at("b")), "12");
  EXPECT_EQ(code_of([&] { write_files({{at("c"), "3"}, {at("a"), "4"}}, Existing::Refused); }), Exit::Output);
  EXPECT_EQ(code_of([&] { write_files({{at("c"), "3"}, {at("missing/d"), "4"}}, Existing::Replaced); }), Exit::Output);
  EXPECT_EQ(code_of([&] { write_files({{at("c"), "3"}, {at("c"), "4"}}, Existing::Refused); }), Exit::Output);
  EXPECT_EQ(read_file(at("a")), "1");
  EXPECT_EQ(count(), 2u);  // c was placed, and removed again
  write_files({{at("a"), "5"}, {at("b"), "6"}}, Existing::Replaced);
  EXPECT_EQ(read_file(at("a")) + read_file(at("b")), "56");
}

TEST_F(Files, WhatCannotBeReadIsAnInputFailure) {
  EXPECT_EQ(code_of([&] { read_file(at("missing")); }), Exit::Input);
  EXPECT_EQ(code_of([&] { read_file(folder_.string()); }), Exit::Input);
}

}  // namespace
}  // namespace cli
