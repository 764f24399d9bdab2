// SPDX-License-Identifier: GPL-2.0-or-later
#include "wall_state.h"

#include <gmock/gmock.h>

#include <limits>
#include <stdexcept>

namespace {

using liggghts_pkg::WallState;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const coupling::Fingerprint kPlate = {{"material", "E = 5", {5.0}}, coupling::word_part("units", "si")};

WallState::Origin origin() { return {kPlate, 4, 3}; }

const char* bytes(const std::vector<double>& numbers) {
  return reinterpret_cast<const char*>(numbers.data());
}

std::string refusal(const WallState::Origin& saved, const WallState::Origin& now) {
  try {
    liggghts_pkg::check_origin(saved, now, "plate.yaml");
  } catch (const std::invalid_argument& problem) {
    return problem.what();
  }
  return "";
}

TEST(WallState, SurvivesPacking) {
  const WallState back =
      liggghts_pkg::unpack_wall_state(bytes(liggghts_pkg::pack({{1.0, 2.0}, {}, {3.0}, origin()})));
  EXPECT_EQ(back.structure, (std::vector<double>{1.0, 2.0}));
  EXPECT_TRUE(back.fields.empty());
  EXPECT_EQ(back.contacts, std::vector<double>{3.0});
  ASSERT_TRUE(back.origin);
  EXPECT_EQ(back.origin->contacts, 4);
  EXPECT_EQ(back.origin->history, 3);
  EXPECT_EQ(refusal(*back.origin, origin()), "");
}

TEST(WallState, OfAnOlderVersionHasNoOrigin) {
  const WallState old = liggghts_pkg::unpack_wall_state(bytes({2.0, 10.0, 11.0, 1.0, 12.0}));
  EXPECT_EQ(old.structure, (std::vector<double>{10.0, 11.0}));
  EXPECT_EQ(old.fields, std::vector<double>{12.0});
  EXPECT_FALSE(old.origin);
  const WallState of_a_wall_at_rest = liggghts_pkg::unpack_wall_state(bytes({0.0, 0.0}));
  EXPECT_TRUE(of_a_wall_at_rest.structure.empty());
}

TEST(WallState, OfANewerVersionIsRefused) {
  EXPECT_THROW(liggghts_pkg::unpack_wall_state(bytes({-5.0, 0.0, 0.0})), std::invalid_argument);
}

TEST(WallState, ThatIsDamagedIsRefused) {
  const auto refused = testing::ThrowsMessage<std::invalid_argument>(HasSubstr("restart file is damaged"));
  const double nan = std::numeric_limits<double>::quiet_NaN(), huge = 1e300;
  for (const std::vector<double>& numbers : std::vector<std::vector<double>>{
           {nan},  // sizes of parts
           {-2.0, huge},
           {-2.0, -1.0},
           {-2.0, 0.5, 0.0, 0.0, 0.0},
           {-2.0, 3.0, 1.0, 2.0},  // which ends too early
           {-2.0, 0.0},
           {-2.0, 0.0, nan},
           {-2.0, 0.0, 0.0, 1.0, nan},  // of a name in the fingerprint
           {-2.0, 0.0, 0.0, 0.0, 0.0},  // counts of contact memory that are not there
           {-2.0, 0.0, 0.0, 0.0, 2.0, 4.0, nan}}) {
    SCOPED_TRACE(testing::PrintToString(numbers));
    EXPECT_THAT([&] { liggghts_pkg::unpack_wall_state(bytes(numbers), numbers.size()); }, refused);
  }
}

TEST(WallState, OfAnotherWallIsRefusedWithWhatDiffers) {
  WallState::Origin cgs = origin();
  cgs.fingerprint[1] = coupling::word_part("units", "cgs");
  EXPECT_THAT(refusal(origin(), cgs), AllOf(HasSubstr("plate.yaml"), HasSubstr("units: si then, cgs now"),
                                            Not(HasSubstr("material:"))));
}

TEST(WallState, FitsIntoItsContactMemory) {
  WallState::Origin other = origin();
  other.history = 0;
  EXPECT_THAT(refusal(origin(), other), AllOf(HasSubstr("3 history values"), HasSubstr("keep 0")));
  other = origin();
  other.contacts = 2;
  EXPECT_THAT(refusal(origin(), other), HasSubstr("use 'contacts 4'"));
  EXPECT_EQ(refusal(other, origin()), "") << "there is room for more";
}

}  // namespace
