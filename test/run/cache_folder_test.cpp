#include "knot_utm/run/cache_folder.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <map>

#include "knot_utm/numeric/invalid_input.hpp"
#include "knot_utm/run/build_identity.hpp"
#include "knot_utm/run/run_folder.hpp"
#include "run/own_folder.hpp"

namespace knot_utm {
namespace {

namespace fs = std::filesystem;

class Cache : public MadeFolder {
 protected:
  const CacheFolder cache{in("cache"), 1000};

  std::size_t files() const {
    std::error_code error;
    std::size_t count = 0;
    for (fs::directory_iterator entry(cache.folder(), error), end; !error && entry != end; ++entry) ++count;
    return count;
  }
  /// As if it had been used so long ago.
  void age(const std::string& name, std::chrono::hours hours) const {
    fs::last_write_time(cache.file_of(name), fs::file_time_type::clock::now() - hours);
  }
};

TEST_F(Cache, HasWhatWasWrittenUnderTheSameText) {
  EXPECT_FALSE(cache.read("a"));
  cache.write("a", "first");
  cache.write("b", std::string("\0\n", 2));
  EXPECT_EQ(cache.read("a"), "first");
  EXPECT_EQ(cache.read("b"), std::string("\0\n", 2));
  EXPECT_FALSE(cache.read("c"));
  cache.write("a", "second");
  EXPECT_EQ(cache.read("a"), "second");
  EXPECT_EQ(files(), 2u) << "nothing else is left";
}

TEST_F(Cache, RemovesWhatWasUsedLeastRecently) {
  for (const char* name : {"a", "b", "c"}) cache.write(name, std::string(300, 'x'));
  age("a", std::chrono::hours(3));
  age("b", std::chrono::hours(2));
  age("c", std::chrono::hours(1));
  EXPECT_TRUE(cache.read("a")) << "it is the newest from now on";
  cache.write("d", std::string(500, 'x'));
  EXPECT_TRUE(cache.read("a"));
  EXPECT_FALSE(cache.read("b"));
  EXPECT_FALSE(cache.read("c"));
  EXPECT_TRUE(cache.read("d"));
  cache.write("e", std::string(1001, 'x'));
  EXPECT_FALSE(cache.read("e")) << "it is larger than all that may be kept";
  EXPECT_TRUE(cache.read("d"));
}

TEST_F(Cache, LeavesForeignFilesAloneAndRemovesPartsThatWereLeft) {
  cache.write("a", "first");
  const std::string notes = cache.folder() + "/notes.kept", part = cache.file_of("a") + ".abcdef.part";
  write_whole(notes, std::string(5000, 'x'));
  write_whole(part, "of a process that was killed");
  cache.write("b", "second");
  EXPECT_TRUE(fs::exists(part)) << "it may be being written";
  fs::last_write_time(part, fs::file_time_type::clock::now() - std::chrono::hours(2));
  cache.write("b", std::string(999, 'x'));
  EXPECT_FALSE(fs::exists(part));
  EXPECT_TRUE(fs::exists(notes));
}

TEST_F(Cache, ThatCannotBeReadOrWrittenIsAsGoodAsNone) {
  cache.write("a", "first");
  const std::string file = cache.file_of("a");
  fs::remove(file);
  fs::create_directories(file + "/in its place");
  EXPECT_FALSE(cache.read("a"));
  cache.write("a", "second");
  EXPECT_EQ(cache.read("a"), "second");

  write_whole(in("file"), "");
  for (const std::string& nowhere : {in("file"), in("file") + "/below", std::string("/proc/nowhere")}) {
    const CacheFolder none(nowhere, 1000);
    none.write("a", "first");
    EXPECT_FALSE(none.read("a")) << nowhere;
  }
  if (geteuid() == 0) return;  // who may write everywhere
  fs::permissions(cache.folder(), fs::perms::owner_read | fs::perms::owner_exec);
  cache.write("b", "third");
  EXPECT_FALSE(cache.read("b"));
  EXPECT_EQ(cache.read("a"), "second") << "it may be read all the same";
  fs::permissions(cache.folder(), fs::perms::owner_all);
}

/// Each process writes letters of its own, and whoever reads sees those of one of them.
TEST_F(Cache, IsWholeWhileSeveralProcessesWriteIt) {
  const CacheFolder large(in("cache"), 1U << 26U);
  constexpr std::size_t kSize = 200000;
  std::vector<pid_t> writers;
  for (const char letter : {'a', 'b', 'c'}) {
    const pid_t process = fork();
    if (process == 0) {
      for (int i = 0; i < 40; ++i) large.write("text", std::string(kSize, letter));
      _exit(0);
    }
    writers.push_back(process);
  }
  int reads = 0;
  for (int i = 0; i < 400; ++i)
    if (const std::optional<std::string> text = large.read("text")) {
      ++reads;
      ASSERT_EQ(*text, std::string(kSize, text->front()));
    }
  for (const pid_t writer : writers) {
    int status = -1;
    waitpid(writer, &status, 0);
    EXPECT_EQ(status, 0);
  }
  EXPECT_TRUE(large.read("text"));
  EXPECT_EQ(files(), 1u) << "no part is left";
}

/// The environment as a test sets it; afterwards it is as it was before.
class CacheOfUser : public MadeFolder {
 protected:
  CacheOfUser() {
    for (const char* name : {"KNOT_UTM_CACHE_DIR", "KNOT_UTM_CACHE_LIMIT", "XDG_CACHE_HOME", "HOME"}) {
      if (const char* value = std::getenv(name)) before_[name] = value;
      unsetenv(name);
    }
  }
  ~CacheOfUser() override {
    for (const char* name : {"KNOT_UTM_CACHE_DIR", "KNOT_UTM_CACHE_LIMIT", "XDG_CACHE_HOME", "HOME"}) unsetenv(name);
    for (const auto& [name, value] : before_) set(name.c_str(), value);
  }
  static void set(const char* name, const std::string& value) { setenv(name, value.c_str(), 1); }
  static std::string folder_of_cache() {
    const std::optional<CacheFolder> cache = CacheFolder::of_user();
    return cache ? cache->folder() : "none";
  }

 private:
  std::map<std::string, std::string> before_;
};

TEST_F(CacheOfUser, StandsWhereTheEnvironmentSays) {
  EXPECT_EQ(folder_of_cache(), "none") << "without a home there is none";
  set("HOME", "/home/of/user");
  EXPECT_EQ(folder_of_cache(), "/home/of/user/.cache/knot_utm");
  set("XDG_CACHE_HOME", "relative");
  EXPECT_EQ(folder_of_cache(), "/home/of/user/.cache/knot_utm");
  set("XDG_CACHE_HOME", "/caches");
  EXPECT_EQ(folder_of_cache(), "/caches/knot_utm");
  set("KNOT_UTM_CACHE_DIR", "own");
  EXPECT_EQ(folder_of_cache(), "own");
  set("KNOT_UTM_CACHE_LIMIT", "0");
  EXPECT_EQ(folder_of_cache(), "none");
}

TEST_F(CacheOfUser, HasTheLimitOfTheEnvironment) {
  set("KNOT_UTM_CACHE_DIR", in("cache"));
  set("KNOT_UTM_CACHE_LIMIT", "1");
  const CacheFolder cache = CacheFolder::of_user().value();
  cache.write("a", std::string((1U << 20U) + 1, 'x'));
  EXPECT_FALSE(cache.read("a"));
  cache.write("a", std::string(1U << 20U, 'x'));
  EXPECT_TRUE(cache.read("a"));
  for (const char* wrong : {"-1", "1.5", "1G", "all", "99999999999999999999", " 1"}) {
    set("KNOT_UTM_CACHE_LIMIT", wrong);
    EXPECT_THROW(CacheFolder::of_user(), InvalidInput) << wrong;
  }
}

TEST(BuildIdentity, IsKnownAndStaysTheSame) {
  EXPECT_GT(build_identity().size(), 100u) << "a build id has twenty bytes, and there are several libraries";
  EXPECT_EQ(&build_identity(), &build_identity());
}

}  // namespace
}  // namespace knot_utm
