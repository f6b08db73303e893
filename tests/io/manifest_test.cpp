#include "io/manifest.hpp"

#include "core/error.hpp"
#include "scratch_folder.hpp"

namespace thinwall::io::test::manifest_test {

namespace {
class Manifest : public ScratchFolder {};
}  // namespace

// The three messages of FIPS 180-2, appendix B, and the empty one.
TEST(Sha256, AgreesWithThePublishedDigests) {
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(sha256(std::string(1000000, 'a')), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

TEST_F(Manifest, HashesAFileOfSeveralPiecesLikeItsBytes) {
  std::string content;
  for (int i = 0; i < 300000; ++i) content += std::to_string(i);
  EXPECT_EQ(sha256_of_file(write("large.bin", content)), sha256(content));
  EXPECT_THROW((void)sha256_of_file(path("absent")), core::DataError);
  EXPECT_THROW((void)sha256_of_file(path(".")), core::DataError);
}

TEST_F(Manifest, ListsEveryFinishedFileByName) {
  std::filesystem::create_directory(path("modes"));
  write("modes/b.vtu", "12");
  write("a.csv", "abc");
  write(".a.partial-12-0.csv", "half");
  const auto records = file_records(path(""));
  ASSERT_EQ(records.size(), 2U);
  EXPECT_EQ(records[0].name, "a.csv");
  EXPECT_EQ(records[0].sha256, sha256("abc"));
  EXPECT_EQ(records[1].name, "modes/b.vtu");
  EXPECT_EQ(records[1].bytes, 2U);
  EXPECT_THROW((void)file_records(path("absent")), core::DataError);
}

}  // namespace thinwall::io::test::manifest_test
