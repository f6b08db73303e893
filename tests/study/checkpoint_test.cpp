// Finished pieces of a run in a file, in whatever order threads finish them.

#include "study/kept/checkpoint.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/atomic_file.hpp"
#include "tests/io/scratch_folder.hpp"

namespace thinwall::study::checkpoint_test {
namespace {

class CheckpointFile : public io::test::ScratchFolder {
 protected:
  /// The bytes of a file to which the pieces were added in this order.
  std::string bytes_of(const std::string& file, const std::vector<std::string>& order) {
    Checkpoint kept(path(file), "key", true);
    for (const std::string& name : order) kept.add(name, "bytes of " + name);
    kept.arrange();
    return core::read_file(path(file));
  }
};

TEST_F(CheckpointFile, DoesNotTellWhichPieceWasFinishedFirst) {
  const std::string sorted = bytes_of("a.bin", {"part-0", "part-1", "part-2"});
  EXPECT_EQ(bytes_of("b.bin", {"part-2", "part-0", "part-1"}), sorted);
  const Checkpoint again(path("b.bin"), "key", false);
  for (const std::string name : {"part-0", "part-1", "part-2"}) {
    const std::string* found = again.find(name);
    ASSERT_TRUE(found) << name;
    EXPECT_EQ(*found, "bytes of " + name);
  }
}

TEST_F(CheckpointFile, GoesOnAfterItWasArranged) {
  bytes_of("c.bin", {"b", "a"});
  Checkpoint kept(path("c.bin"), "key", false);
  kept.add("aa", "between");
  kept.arrange();
  EXPECT_EQ(*Checkpoint(path("c.bin"), "key", false).find("aa"), "between");
  EXPECT_EQ(*Checkpoint(path("c.bin"), "key", false).find("b"), "bytes of b");
}

}  // namespace
}  // namespace thinwall::study::checkpoint_test
