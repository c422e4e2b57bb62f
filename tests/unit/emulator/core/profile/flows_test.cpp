// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/profile/flows.hpp"

#include "emulator/core/profile/paths.hpp"
#include "emulator/core/profile/text.hpp"

#include <chrono>
#include <gtest/gtest.h>

namespace hapnet::emulator::flows_test {
namespace {

using namespace std::chrono_literals;

constexpr std::string_view two_flows = R"(
[both]
delay = "20ms"
mtu = "1200B"
[[flow]]
name = "voice"
match = { protocol = "udp", port = 5004 }
both.delay = "80ms"
up.loss = "2%"
[[flow]]
name = "ssh"
match = { protocol = "tcp", port = 22 }
pass = true
[[at]]
time = "10s"
both.delay = "30ms"
both.mtu = "1300B"
flow.voice.up.loss = "5%"
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

/// One flow that matches, with these lines.
std::string flow_with(std::string_view lines)
{
    return fmt::format("[[flow]]\nname = \"voice\"\nmatch = {{ port = 5004 }}\n{}\n", lines);
}

TEST(Flows, HaveNamesMatchesAndConditions)
{
    const Profile profile = profile_in(two_flows);
    ASSERT_EQ(profile.flows.size(), 2U);
    EXPECT_EQ(profile.flows[0].name, "voice");
    EXPECT_EQ(profile.flows[0].match, (Match{.protocol = 17, .port = NumberRange{5004, 5004}}));
    EXPECT_FALSE(profile.flows[0].passes);
    EXPECT_TRUE(profile.flows[1].passes);
    const Profile voice = profile_of(profile, "flow.voice");
    EXPECT_EQ(voice.path.up.delay, constant(80ms));
    EXPECT_EQ(voice.path.down.delay, constant(80ms));
    EXPECT_EQ(voice.path.up.loss.size(), 1U);
    EXPECT_TRUE(voice.path.down.loss.empty());
}

TEST(Flows, InheritNothingButTheMtu)
{
    const Profile profile = profile_in(two_flows);
    const Profile voice = profile_of(profile, "flow.voice");
    EXPECT_EQ(voice.path.up.mtu.bytes_max, 1200U);
    ASSERT_EQ(voice.timeline.size(), 1U);
    EXPECT_EQ(voice.timeline[0].down, (Patch{.mtu = Mtu{1300}}));
    EXPECT_TRUE(voice.timeline[0].up.loss);
    EXPECT_FALSE(voice.timeline[0].up.delay);
    const Profile untouched = profile_of(profile, "flow.ssh");
    EXPECT_EQ(untouched.path, Path{});
    EXPECT_EQ(untouched.timeline[0].up, Patch{});
    const Profile rest = profile_of(profile, "");
    EXPECT_EQ(rest.path.up.delay, constant(20ms));
    EXPECT_EQ(rest.timeline[0].up.delay, constant(30ms));
    EXPECT_FALSE(rest.timeline[0].up.loss);
}

TEST(Flows, KeepAnMtuOfTheirOwn)
{
    const Profile profile =
        profile_in("[both]\nmtu = \"1200B\"\n" + flow_with("up.mtu = \"900B\"") +
                   "[[at]]\ntime = \"1s\"\nboth.mtu = \"1300B\"\n");
    const Profile voice = profile_of(profile, "flow.voice");
    EXPECT_EQ(voice.path.up.mtu.bytes_max, 900U);
    EXPECT_EQ(voice.path.down.mtu.bytes_max, 1200U);
    EXPECT_FALSE(voice.timeline[0].up.mtu);
    EXPECT_TRUE(voice.timeline[0].down.mtu);
}

TEST(Flows, MayHaveOtherConditionsOnOnePath)
{
    const Profile profile = profile_in(R"(
[[flow]]
name = "voice"
match = { port = 5004 }
both.delay = "80ms"
[client.3.flow.voice]
up.delay = "200ms"
[link."1-2"]
flow.voice.delay = "90ms"
[[at]]
time = "1s"
client.3.flow.voice.up.loss = "1%"
)");
    EXPECT_EQ(profile_of(profile, "client.3.flow.voice").path.up.delay, constant(200ms));
    EXPECT_EQ(profile_of(profile, "client.3.flow.voice").path.down.delay, constant(80ms));
    EXPECT_TRUE(profile_of(profile, "client.3.flow.voice").timeline[0].up.loss);
    EXPECT_EQ(profile_of(profile, "client.4.flow.voice").path.up.delay, constant(80ms));
    EXPECT_EQ(profile_of(profile, "1-2.flow.voice").path.up.delay, constant(90ms));
    EXPECT_EQ(profile_of(profile, "1-2.flow.voice").path.down.delay, constant(80ms));
    EXPECT_EQ(profile_of(profile, "client.3").path, Path{});
    EXPECT_EQ(parse_profile(to_text(profile), "again", {}), profile) << to_text(profile);
}

TEST(Flows, ArePrintedAsTheyAreRead)
{
    const Profile profile = profile_in(two_flows);
    const auto text = to_text(profile);
    EXPECT_EQ(parse_profile(text, "again", {}), profile) << text;
    EXPECT_NE(text.find(R"([[flow]]
name = "voice"
match = { protocol = "udp", port = 5004 }
both.delay = "80ms"
up.loss = "2%"

[[flow]]
name = "ssh"
match = { protocol = "tcp", port = 22 }
pass = true
)"),
              std::string::npos)
        << text;
    EXPECT_NE(text.find("flow.voice.up.loss = \"5%\"\n"), std::string::npos) << text;
}

TEST(Flows, OfOneProfileAreJoinedFromThoseOfItsPaths)
{
    for (const std::string_view text :
         {two_flows, std::string_view{"[both]\ndelay = \"1ms\"\n[[flow]]\nname = \"a\"\nmatch = "
                                      "{ ip = 6 }\nrate = \"shared\"\n[link.wan]\nflow.a.delay = "
                                      "\"5ms\"\n"}}) {
        const Profile profile = profile_in(text);
        std::vector<NamedProfile> own;
        for (const char* const path : {"lan", "wan"}) {
            own.push_back({path, profile_of(profile, path)});
            for (const Flow& flow : profile.flows) {
                const auto name = flow_path(path, flow.name);
                own.push_back({name, profile_of(profile, name)});
            }
        }
        const Profile all = joined(own, profile.flows);
        EXPECT_EQ(all.flows, profile.flows);
        for (const auto& [path, of_path] : own) {
            EXPECT_EQ(profile_of(all, path).path, of_path.path) << path << "\n" << to_text(all);
            for (const auto time : {0s, 5s, 10s, 20s}) {
                EXPECT_EQ(Timeline{profile_of(all, path)}.at(time), Timeline{of_path}.at(time));
            }
        }
        EXPECT_EQ(parse_profile(to_text(all), "again", {}), all) << to_text(all);
    }
}

TEST(Flows, SayWhereTheyAreWrongAndWhatWouldBeRight)
{
    EXPECT_EQ(refusal_of("[[flow]]\nname = \"Voice\"\nmatch = { port = 1 }\n"),
              "test.toml:2:8: 'Voice' is not the name of a flow: write 1 to 32 characters of a-z, "
              "0-9 and -");
    EXPECT_NE(refusal_of("[[flow]]\nname = \"rest\"\nmatch = { port = 1 }\n").find("meaning"),
              std::string::npos);
    EXPECT_NE(refusal_of("[[flow]]\nmatch = { port = 1 }\n").find("name"), std::string::npos);
    EXPECT_NE(refusal_of("[[flow]]\nname = \"a\"\n").find("match"), std::string::npos);
    EXPECT_NE(refusal_of("[[flow]]\nname = \"a\"\nmatch = {}\n").find("every packet"),
              std::string::npos);
    EXPECT_NE(refusal_of(flow_with("delay = \"5ms\"")).find("[both], [up] or [down]"),
              std::string::npos);
    EXPECT_NE(refusal_of(flow_with("pass = true\nup.delay = \"5ms\"")).find("untouched"),
              std::string::npos);
    EXPECT_NE(refusal_of(flow_with("rate = \"shared\"\nup.rate = \"1Mbit/s\"")).find("shared"),
              std::string::npos);
    EXPECT_NE(refusal_of(flow_with("rate = \"1Mbit/s\"")).find("up.rate"), std::string::npos);
    EXPECT_NE(refusal_of(flow_with("") + flow_with("")).find("already"), std::string::npos);
    EXPECT_EQ(refusal_of(flow_with("") + "[[at]]\ntime = \"1s\"\nflow.voise.up.loss = \"1%\"\n"),
              "test.toml:7:6: there is no flow 'voise': did you mean 'voice'?");
    EXPECT_NE(refusal_of("[flow.voice]\nup.delay = \"1ms\"\n").find("[[flow]]"), std::string::npos);
    EXPECT_NE(refusal_of(flow_with("rate = \"shared\"") +
                         "[[at]]\ntime = \"1s\"\nflow.voice.up.rate = \"1Mbit/s\"\n")
                  .find("shares the rate"),
              std::string::npos);
}

TEST(Flows, AreSixteenAtMost)
{
    std::string text;
    for (int i = 0; i < 16; ++i) {
        text += fmt::format("[[flow]]\nname = \"f{}\"\nmatch = {{ port = {} }}\n", i, i);
    }
    EXPECT_EQ(profile_in(text).flows.size(), 16U);
    EXPECT_NE(refusal_of(text + flow_with("")).find("at most 16 flows"), std::string::npos);
}

TEST(Flows, AreSetByTheirKeys)
{
    const Profile profile = profile_in(two_flows);
    const PathNames names = with_flows({}, profile.flows);
    const auto set = parse_setting("flow.voice.up.delay", "200ms", {}, names);
    ASSERT_TRUE(set) << set.error().message;
    EXPECT_EQ(set->path, "flow.voice");
    EXPECT_EQ(set->direction, Direction::up);
    const std::vector<Setting> settings{*set};
    EXPECT_EQ(with_settings({}, settings, "flow.voice")->up.delay, constant(200ms));
    EXPECT_EQ(with_settings({}, settings, "client.3.flow.voice")->up.delay, constant(200ms));
    EXPECT_EQ(with_settings({}, settings, "client.3")->up, Conditions{});
    const std::vector<Setting> of_all{*parse_setting("up.delay", "5ms", {}, names)};
    EXPECT_EQ(with_settings({}, of_all, "flow.voice")->up, Conditions{});
    EXPECT_EQ(parse_setting("flow.voise.delay", "5ms", {}, names).error().message,
              "flow.voise.delay: there is no flow 'voise': did you mean 'voice'?");
    EXPECT_NE(parse_setting("flow.ssh.delay", "5ms", {}, names).error().message.find("untouched"),
              std::string::npos);
    EXPECT_NE(parse_setting("flow.voice.dealy", "5ms", {}, names)
                  .error()
                  .message.find("did you mean 'flow.voice.delay'?"),
              std::string::npos);
}

TEST(Flows, OfARunCannotChange)
{
    const Profile profile = profile_in(two_flows);
    EXPECT_TRUE(ensure_same_flows(profile, profile.flows));
    Profile other = profile;
    other.flows.pop_back();
    EXPECT_EQ(ensure_same_flows(other, profile.flows).error().message,
              "the flows of a run cannot change: the profile has voice, and the run has voice, "
              "ssh. Write [[flow]] as at the start, or start again");
    EXPECT_FALSE(ensure_same_flows({}, profile.flows));
}

} // namespace
} // namespace hapnet::emulator::flows_test
