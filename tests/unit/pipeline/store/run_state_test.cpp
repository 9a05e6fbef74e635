// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/store/run_state.hpp"

#include <string>
#include <tuple>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"
#include "tessera/base/version.hpp"

#include "pipeline/store/fill_record.hpp"
#include "support/temporary_folder.hpp"

namespace tessera::pipeline {
namespace {

// What another version notes of a run.
struct OtherIdentity {
  std::string version{};
  std::string else_noted = "of another layout";

  static auto fields(auto& self) { return std::tie(self.version, self.else_noted); }
};

class RunStateOfOthers : public ::testing::Test {
 protected:
  [[nodiscard]] io::RecordStore store() const
  {
    return io::RecordStore(store_folder(folder_.path()));
  }

  // What --resume is told when `record` is there; empty if it goes on.
  [[nodiscard]] std::string refusal(const Bytes& record) const
  {
    store().put("run", record);
    try {
      RunState(folder_.path(), {}, true).require_same_run({});
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  }

  testing::TemporaryFolder folder_;
};

TEST_F(RunStateOfOthers, NamesBothVersionsWhateverElseTheOtherOneNotes)
{
  for (const std::string& other :
       {record_version("0.0.1"), std::string(version()) + ", records 3"}) {
    const std::string text = refusal(to_bytes(OtherIdentity{other}));
    EXPECT_NE(text.find("begun by version " + other + ", this is " + record_version()),
              std::string::npos)
        << text;
    EXPECT_TRUE(store().contains("run"));  // Nothing is lost: that version can go on.
  }
}

TEST_F(RunStateOfOthers, GoesOnWithItsOwn)
{
  const RunState state(folder_.path(), {}, true);
  state.require_same_run({{1, 2}, {}});
  EXPECT_NO_THROW(state.require_same_run({{1, 2}, {}}));
  EXPECT_THROW(state.require_same_run({{1, 3}, {}}), InputError);
}

}  // namespace
}  // namespace tessera::pipeline
