#include "shlight/scene/model_folder.h"

#include <gtest/gtest.h>

#include <fstream>

#include "shlight/core/temporary_folder.h"

namespace shlight {
namespace {

class ModelFolderTest : public testing::Test {
 protected:
  ModelFolderTest() {
    std::filesystem::create_directories(temporary_.path() / "model/maps");
    for (const char* name : {"secret.png", "model/a.obj", "model/b.png", "model/maps/c.png", "model/100% d e.png"})
      std::ofstream(temporary_.path() / name) << "x";
    folder_.emplace(temporary_.path() / "model/a.obj");
  }
  TemporaryFolder temporary_;
  std::optional<ModelFolder> folder_;
};

TEST_F(ModelFolderTest, FindsFilesHoweverTheyAreNamed) {
  for (const char* name : {"b.png", "./b.png", "maps/../b.png", "C:\\art\\b.png", "/home/artist/b.png", "../../b.png"})
    EXPECT_TRUE(folder_->find(name)) << name;
  for (const char* name : {"maps/c.png", "maps\\c.png", ".\\maps\\c.png"}) EXPECT_TRUE(folder_->find(name)) << name;
}

TEST_F(ModelFolderTest, FindsNamesThatAreUris) {
  EXPECT_TRUE(folder_->find("maps%2fc.png"));
  for (const char* name : {"100% d e.png", "100%25%20d%20e.png", "art/100%25%20d e.png"})
    EXPECT_TRUE(folder_->find(name)) << name;
}

TEST_F(ModelFolderTest, NeverLeavesTheFolder) {
  const std::string secret = (temporary_.path() / "secret.png").string();
  std::filesystem::create_symlink(secret, temporary_.path() / "model/link.png");
  for (const std::string& name :
       {secret, std::string("../secret.png"), std::string("maps/../../secret.png"), std::string("..\\secret.png"),
        std::string("%2e%2e%2fsecret.png"), std::string("link.png")})
    EXPECT_FALSE(folder_->find(name)) << name;
  EXPECT_FALSE(folder_->may_read(secret));
  EXPECT_FALSE(folder_->may_read("/dev/zero"));
}

TEST_F(ModelFolderTest, NothingIsNoFile) {
  for (const char* name : {"", ".", "..", "maps", "maps/", "/", "missing.png"})
    EXPECT_FALSE(folder_->find(name)) << name;
}

TEST_F(ModelFolderTest, ModelMayBeALinkFromElsewhere) {
  std::filesystem::create_symlink(temporary_.path() / "model/a.obj", temporary_.path() / "link.obj");
  const ModelFolder folder(temporary_.path() / "link.obj");
  EXPECT_TRUE(folder.may_read(temporary_.path() / "link.obj"));
  EXPECT_TRUE(folder.find("secret.png"));
}

TEST(Printable, ReplacesControlCharacters) {
  EXPECT_EQ(printable("a\x1b[31m\nü"), "a?[31m?ü");
}

}  // namespace
}  // namespace shlight
