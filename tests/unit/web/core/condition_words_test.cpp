// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "web/core/condition_words.hpp"

#include <gtest/gtest.h>

namespace hapnet::web {
namespace {

using Json = nlohmann::ordered_json;

Json shown(double position_s, const Json& next_s, const Json& conditions,
           const Json& live = Json::array())
{
    return {{"timeline", {{"position_s", position_s}, {"next_change_in_s", next_s}}},
            {"conditions", conditions},
            {"live", live}};
}

TEST(ConditionWords, NameASharedSettingOnceAndThreeSettingsAtMost)
{
    EXPECT_EQ(words_of({{"up.delay", "40ms"}, {"down.delay", "40ms"}}), "both.delay 40ms");
    EXPECT_EQ(words_of({{"up.delay", "40ms"}, {"down.delay", "50ms"}}),
              "up.delay 40ms, down.delay 50ms");
    EXPECT_EQ(words_of({{"both.loss", "1%"}, {"a", 1}, {"b", "2"}, {"c", "3"}, {"d", "4"}}),
              "both.loss 1%, a 1, b 2 and 2 more");
    EXPECT_EQ(words_of(nullptr), "");
}

TEST(ConditionWords, NameTheTimelineAndWhatItChanged)
{
    EXPECT_EQ(words_of_change(shown(0.5, 1.5, {{"up.delay", "10ms"}, {"up.loss", "1%"}}),
                              shown(2.1, nullptr, {{"up.delay", "40ms"}, {"up.loss", "1%"}})),
              "the timeline: up.delay 40ms");
}

TEST(ConditionWords, NameAnotherProgramAndASettingThatIsGone)
{
    const Json lossy{{"up.delay", "10ms"}, {"up.loss", "1%"}};
    const Json plain{{"up.delay", "10ms"}};
    EXPECT_EQ(words_of_change(shown(0.5, 1.5, lossy), shown(1.0, 1.0, plain)),
              "another program: up.loss none");
    const Json live = Json::array({{{"settings", {{"up.loss", "1%"}}}, {"remaining_s", 2}}});
    EXPECT_EQ(words_of_change(shown(0.5, 0.1, plain), shown(1.0, 2.0, lossy, live)),
              "another program: up.loss 1%");
    EXPECT_EQ(words_of_change(shown(1.0, 2.0, lossy, live), shown(3.0, nullptr, plain)),
              "a setting has ended: up.loss none");
    EXPECT_EQ(words_of_change(nullptr, Json::object()), "another program");
}

} // namespace
} // namespace hapnet::web
