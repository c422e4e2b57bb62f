// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/profile/regimes.hpp"

#include "emulator/core/profile/flows.hpp"
#include "emulator/core/profile/paths.hpp"
#include "emulator/core/profile/settings.hpp"
#include "emulator/core/profile/text.hpp"

#include <chrono>
#include <gtest/gtest.h>
#include <vector>

namespace hapnet::emulator::profile_regimes_test {
namespace {

using namespace std::chrono_literals;
using namespace base::literals; // NOLINT(google-build-using-namespace): literals only

constexpr std::string_view two_regimes = R"(
[up]
jitter = "1ms"
[[up.regime]]
name = "good"
stay = "4s"
to = { bad = 1 }
delay = "20ms"
loss = "0.1%"
[[up.regime]]
name = "bad"
stay = "150ms"
delay = "60ms"
jitter = { law = "log-normal", mean = "30ms", sd = "40ms", correlation_time = "100ms" }
loss = { law = "gilbert-elliott", good_to_bad = "5%", bad_to_good = "25%" }
rate = "2Mbit/s"
order = "free"
)";

Profile profile_in(std::string_view text)
{
    const auto profile = parse_profile(text, "test.toml", {});
    EXPECT_TRUE(profile) << (profile ? "" : profile.error().message) << "\n" << text;
    return profile.value_or(Profile{});
}

std::string refusal_of(std::string_view text)
{
    const auto profile = parse_profile(text, "test.toml", {});
    EXPECT_FALSE(profile) << text;
    return profile ? "" : profile.error().message;
}

/// Returns a profile's path with the settings applied, as the control socket does it.
base::Result<Path> set_on(const Profile& profile, std::string_view key, std::string_view value)
{
    const auto setting = parse_setting(key, value, {}, with_flows({}, profile.flows));
    if (!setting) return tl::unexpected{setting.error()};
    const std::vector<Setting> settings{*setting};
    const auto name = setting->path;
    auto after = with_settings(profile_of(profile, name).path, settings, name);
    if (!after) return after;
    if (const auto own = ensure_own_settings(settings, name, *after); !own) {
        return tl::unexpected{own.error()};
    }
    return after;
}

std::string error_of(const base::Result<Path>& result)
{
    EXPECT_FALSE(result);
    return result ? "" : result.error().message;
}

TEST(ProfileRegimes, HaveNamesStaysAndConditions)
{
    const Profile profile = profile_in(two_regimes);
    const auto& all = profile.path.up.regimes.all;
    ASSERT_EQ(all.size(), 2U);
    EXPECT_EQ(all[0].name, "good");
    EXPECT_EQ(all[0].stay, 4s);
    EXPECT_EQ(all[0].own.delay, constant(20ms));
    EXPECT_FALSE(all[0].own.jitter);
    EXPECT_EQ(all[1].own.rate->bits_per_second, 2'000'000U);
    EXPECT_EQ(all[1].own.order, Order::free);
    EXPECT_EQ(all[1].own.jitter->correlation_time, 100ms);
    EXPECT_TRUE(profile.path.down.regimes.empty());
    const Conditions good = in_regime(profile.path.up, 0);
    EXPECT_EQ(good.jitter, uniform(1ms));
    EXPECT_TRUE(good.regimes.empty());
}

TEST(ProfileRegimes, ReadBackAsTheyArePrinted)
{
    for (const std::string& more :
         {std::string{}, std::string{"[[at]]\ntime = \"1s\"\nup.regime.bad.loss = \"9%\"\n"},
          std::string{"[[flow]]\nname = \"voice\"\nmatch = { port = 5004 }\n[[flow.up.regime]]\n"
                      "name = \"a\"\nstay = \"1s\"\ndelay = \"1ms\"\n[[flow.up.regime]]\nname = "
                      "\"b\"\nstay = \"2s\"\n"}}) {
        const Profile profile = profile_in(std::string{two_regimes} + more);
        EXPECT_EQ(profile_in(to_text(profile)), profile) << to_text(profile);
    }
    const Profile both =
        profile_in("[both]\nregimes = \"together\"\n[[both.regime]]\nname = \"a\"\n"
                   "stay = \"1s\"\n[[both.regime]]\nname = \"b\"\nstay = \"2s\"\n"
                   "[up.regime.b]\ndelay = \"9ms\"\n");
    EXPECT_TRUE(both.path.up.regimes.are_together);
    EXPECT_TRUE(both.path.down.regimes.are_together);
    EXPECT_EQ(both.path.up.regimes.all[1].own.delay, constant(9ms));
    EXPECT_FALSE(both.path.down.regimes.all[1].own.delay);
    EXPECT_EQ(profile_in(to_text(both)), both) << to_text(both);
}

TEST(ProfileRegimes, BelongToFlowsToo)
{
    const Profile profile = profile_in(R"(
[[flow]]
name = "voice"
match = { port = 5004 }
[[flow.up.regime]]
name = "good"
stay = "1s"
[[flow.up.regime]]
name = "bad"
stay = "1s"
delay = "50ms"
)");
    EXPECT_TRUE(has_regimes(profile));
    const auto names = regimes_of_paths(profile);
    EXPECT_EQ(names("flow.voice")[0], (RegimeNames{"good", "bad"}));
    EXPECT_TRUE(names("")[0].empty());
    const auto after = set_on(profile, "flow.voice.up.regime.bad.delay", "70ms");
    ASSERT_TRUE(after) << after.error().message;
    EXPECT_EQ(after->up.regimes.all[1].own.delay, constant(70ms));
}

TEST(ProfileRegimes, AreSetOneByOne)
{
    const Profile profile = profile_in(two_regimes);
    const auto after = set_on(profile, "up.regime.bad.delay", "200ms");
    ASSERT_TRUE(after) << after.error().message;
    EXPECT_EQ(after->up.regimes.all[1].own.delay, constant(200ms));
    EXPECT_EQ(after->up.regimes.all[0], profile.path.up.regimes.all[0]);
    EXPECT_EQ(after->down, profile.path.down);
    EXPECT_TRUE(ensure_same_regimes(*after, profile.path));
    EXPECT_EQ(error_of(set_on(profile, "up.regime.worse.delay", "2ms")),
              "there is no regime 'worse': use one of good, bad");
    EXPECT_NE(error_of(set_on(profile, "down.regime.bad.delay", "2ms")).find("[[up.regime]]"),
              std::string::npos);
    EXPECT_NE(error_of(set_on(profile, "up.regime.bad.mtu", "900B")).find("a regime sets rate"),
              std::string::npos);
}

TEST(ProfileRegimes, LeaveNothingToSettingsOfTheDirectionThatTheySetThemselves)
{
    const Profile profile = profile_in(two_regimes);
    EXPECT_EQ(error_of(set_on(profile, "up.delay", "100ms")),
              "up.delay: the regimes set the delay (good, bad): write up.regime.good.delay or "
              "up.regime.bad.delay");
    EXPECT_NE(error_of(set_on(profile, "loss", "1%")).find("up.regime.good.loss"),
              std::string::npos);
    EXPECT_NE(error_of(set_on(profile, "up.burst_loss", "1/100")).find("up.regime.good.loss"),
              std::string::npos);
    EXPECT_TRUE(set_on(profile, "down.delay", "100ms"));
    EXPECT_TRUE(set_on(profile, "up.corrupt", "1%"));
}

TEST(ProfileRegimes, ChangeOnATimelineButForTheirNames)
{
    const Profile profile = profile_in(std::string{two_regimes} +
                                       "[[at]]\ntime = \"1s\"\nup.regime.bad.delay = \"80ms\"\n"
                                       "[[at]]\ntime = \"2s\"\nup.regime.good.delay = \"30ms\"\n");
    const Path after = Timeline{profile}.at(3s);
    EXPECT_EQ(after.up.regimes.all[0].own.delay, constant(30ms));
    EXPECT_EQ(after.up.regimes.all[1].own.delay, constant(80ms));
    EXPECT_NE(refusal_of(std::string{two_regimes} + "[[at]]\ntime = \"1s\"\nup.regime = \"none\"\n")
                  .find("the regimes of a run cannot change"),
              std::string::npos);
}

TEST(ProfileRegimes, AreRefusedWithACure)
{
    const auto with = [](std::string_view lines) {
        return fmt::format("[[up.regime]]\nname = \"a\"\nstay = \"1s\"\n[[up.regime]]\nname = "
                           "\"b\"\nstay = \"1s\"\n{}\n",
                           lines);
    };
    EXPECT_TRUE(parse_profile(with(""), "test.toml", {}));
    EXPECT_NE(refusal_of(with("mtu = \"900B\"")).find("mtu"), std::string::npos);
    EXPECT_NE(refusal_of(with("to = { x = 1 }")).find("'x', which is no regime"),
              std::string::npos);
    EXPECT_NE(refusal_of("[up]\nregimes = \"together\"\n" + with("")).find("below [both]"),
              std::string::npos);
    EXPECT_NE(refusal_of("[both]\nregimes = \"together\"\n" + with("")).find("[[both.regime]]"),
              std::string::npos);
    EXPECT_NE(refusal_of("[[up.regime]]\nname = \"Bad\"\nstay = \"1s\"\n").find("a regime"),
              std::string::npos);
    EXPECT_NE(refusal_of("[[up.regime]]\nname = \"a\"\n").find("stay"), std::string::npos);
    EXPECT_NE(refusal_of("[[flow]]\nname = \"voice\"\nmatch = { port = 1 }\nrate = \"shared\"\n"
                         "[[flow.up.regime]]\nname = \"a\"\nstay = \"1s\"\nrate = \"1Mbit/s\"\n"
                         "[[flow.up.regime]]\nname = \"b\"\nstay = \"1s\"\n")
                  .find("shared"),
              std::string::npos);
}

} // namespace
} // namespace hapnet::emulator::profile_regimes_test
