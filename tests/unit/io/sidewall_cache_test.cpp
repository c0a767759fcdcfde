// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/io/inputs/sidewall_cache.h"

#include <cstdlib>

#include <gmock/gmock.h>

#include "furrow/io/files/cache.h"
#include "furrow/io/files/replace_file.h"
#include "furrow/io/inputs/tyre_file.h"
#include "scratch.h"
#include "tests/support/error_of.h"

namespace furrow::sidewall_cache_test {
namespace {

using test::error_of;
using ::testing::HasSubstr;

class SidewallCacheTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (const char* value = std::getenv("FURROW_CACHE")) before_ = value;
    setenv("FURROW_CACHE", scratch_.path("cache").c_str(), 1);
  }
  void TearDown() override {
    if (before_.empty())
      unsetenv("FURROW_CACHE");
    else
      setenv("FURROW_CACHE", before_.c_str(), 1);
  }
  std::vector<std::string> files() const {
    std::vector<std::string> names;
    if (std::filesystem::exists(cache_folder()))
      for (const auto& entry : std::filesystem::directory_iterator(cache_folder()))
        names.push_back(entry.path().string());
    return names;
  }

  const SidewallParameters sidewall_ =
      read_tyre_file(FURROW_SOURCE_DIR "/inputs/tyres/p235_75r15.yaml").sidewall;
  Scratch scratch_;
  std::string before_;
};

TEST_F(SidewallCacheTest, StoredTableIsReused) {
  const auto made = open_sidewall_table(sidewall_, 103e3);
  ASSERT_EQ(files().size(), 1u);
  EXPECT_THAT(files().front(), HasSubstr("cache/sidewall-"));
  const auto time = std::filesystem::last_write_time(files().front());
  EXPECT_EQ(open_sidewall_table(sidewall_, 103e3)->coefficients(), made->coefficients());
  EXPECT_EQ(std::filesystem::last_write_time(files().front()), time);
}

TEST_F(SidewallCacheTest, AnyChangedInputGivesAnotherTable) {
  SidewallTableGrid grid;
  SidewallParameters changed = sidewall_;
  open_sidewall_table(sidewall_, 103e3);
  open_sidewall_table(sidewall_, 103e3 + 1e-9);
  changed.bending[4] *= 1.0 + 1e-15;
  open_sidewall_table(changed, 103e3);
  grid.chord_nodes += 1;
  open_sidewall_table(sidewall_, 103e3, grid);
  EXPECT_EQ(files().size(), 4u);
}

TEST_F(SidewallCacheTest, DamagedFileIsReplaced) {
  const auto made = open_sidewall_table(sidewall_, 103e3);
  const std::string path = files().front();
  const std::string whole = read_text_file(path);
  write_text_file(path, whole.substr(0, whole.size() / 3));
  EXPECT_EQ(open_sidewall_table(sidewall_, 103e3)->coefficients(), made->coefficients());
  EXPECT_EQ(read_text_file(path).size(), whole.size());
  EXPECT_EQ(files().size(), 1u);
}

TEST_F(SidewallCacheTest, LinkAtTheTemporaryNameIsNotFollowed) {
  open_sidewall_table(sidewall_, 103e3);
  const std::string path = files().front();
  std::filesystem::remove(path);
  write_text_file(scratch_.path("notes"), "of the user");
  char host[256] = "";
  gethostname(host, sizeof host - 1);
  std::filesystem::create_symlink(scratch_.path("notes"),
                                  path + "." + host + "." + std::to_string(getpid()) + ".part");
  open_sidewall_table(sidewall_, 103e3);
  EXPECT_EQ(read_text_file(scratch_.path("notes")), "of the user");
  EXPECT_EQ(files(), std::vector<std::string>{path});
  EXPECT_TRUE(std::filesystem::is_regular_file(std::filesystem::symlink_status(path)));
}

TEST_F(SidewallCacheTest, FilesThatOtherUsersCanChangeAreReplaced) {
  namespace fs = std::filesystem;
  const auto made = open_sidewall_table(sidewall_, 103e3);
  const std::string path = files().front(), elsewhere = scratch_.path("elsewhere.h5");
  fs::rename(path, elsewhere);
  fs::create_symlink(elsewhere, path);
  EXPECT_EQ(distrust(path), "is a link");
  EXPECT_EQ(open_sidewall_table(sidewall_, 103e3)->coefficients(), made->coefficients());
  EXPECT_FALSE(fs::is_symlink(path));
  EXPECT_EQ(distrust(path), "");
  fs::permissions(path, fs::perms::others_write, fs::perm_options::add);
  EXPECT_EQ(distrust(path), "may be written by all users");
  open_sidewall_table(sidewall_, 103e3);
  EXPECT_EQ(distrust(path), "");
  EXPECT_EQ(distrust(scratch_.path("absent")), "");
}

TEST_F(SidewallCacheTest, TableIsNotStoredWithoutAFolder) {
  write_text_file(scratch_.path("file"), "no folder");
  setenv("FURROW_CACHE", scratch_.path("file/below").c_str(), 1);
  EXPECT_FALSE(open_sidewall_table(sidewall_, 103e3)->coefficients().empty());
  EXPECT_EQ(read_text_file(scratch_.path("file")), "no folder");
}

TEST_F(SidewallCacheTest, TableAndDirectSolutionAgree) {
  const SidewallEnd end{-0.004, 0.12, 0.1};
  SidewallResponse looked_up, solved;
  open_sidewall("table", sidewall_, 103e3)->evaluate(&end, &looked_up, 1, false);
  open_sidewall("direct", sidewall_, 103e3)->evaluate(&end, &solved, 1, false);
  EXPECT_NE(looked_up.on_tread, solved.on_tread);
  EXPECT_LT((looked_up.on_tread - solved.on_tread).norm(), 1e-5 * solved.on_tread.norm());
  EXPECT_THAT(error_of([&] { open_sidewall("spline", sidewall_, 103e3); }),
              HasSubstr("sidewall is 'spline'; allowed: one of: table, direct"));
}

TEST(ContentHash, HashIsFnv1a) {
  // Published test vectors of FNV-1a, 64 bits
  EXPECT_EQ(content_hash(""), "cbf29ce484222325");
  EXPECT_EQ(content_hash("a"), "af63dc4c8601ec8c");
  EXPECT_EQ(content_hash("foobar"), "85944171f73967e8");
}

}  // namespace
}  // namespace furrow::sidewall_cache_test
