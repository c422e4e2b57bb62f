// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/all_paths.hpp"

#include "emulator/core/profile/text.hpp"

#include <chrono>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace hapnet::emulator::all_paths_test {
namespace {

using namespace std::chrono_literals;

const base::TimePoint start{100s};

Paths::Setup part(std::vector<std::string> elsewhere, bool takes_newcomers = false)
{
    return {.start = start,
            .limits = {.datagrams_max = 64, .bytes_max = 1 << 20},
            .takes_newcomers = takes_newcomers,
            .elsewhere = std::move(elsewhere)};
}

Profile parsed(std::string_view text) { return parse_profile(text, "all.toml", {}).value(); }

/// Sets the delay of the path of this name, or of all for an empty name.
base::Result<void> set(AllPaths& all, const std::string& only, base::Duration delay,
                       base::TimePoint now)
{
    std::vector<std::string> mentioned;
    if (!only.empty()) mentioned.push_back(only);
    return all.apply(
        [&](std::string_view name, const Path&) -> base::Result<Command> {
            Patch patch;
            if (only.empty() || name == only) patch.delay = Variation{ConstantLaw{delay}, {}};
            return Set{patch, patch};
        },
        mentioned, now);
}

base::Duration delay_of(const Director& director)
{
    return std::get<ConstantLaw>(director.path().up.delay.law).value;
}

base::Duration delay_of(const AllPaths& all, std::string_view name)
{
    for (const auto& [own, director] : all.deciders()) {
        if (own == name) return delay_of(*director);
    }
    return -1s;
}

constexpr std::string_view steps = "[both]\ndelay = \"10ms\"\n"
                                   "[[at]]\ntime = \"1s\"\nall.delay = \"30ms\"\n"
                                   "[[at]]\ntime = \"2s\"\nlink.1-3.delay = \"40ms\"\n";

TEST(AllPaths, HaveOneGenerationThatEachPartCountsByItself)
{
    Paths one{parsed(steps), part({"1-3"})};
    Paths other{parsed(steps), part({"1-2"})};
    std::ignore = one.add("1-2");
    std::ignore = other.add("1-3");
    AllPaths all{{&one, &other}};
    one.advance(start + 2s - 1ns);
    EXPECT_EQ(all.generation(), 2U);
    one.advance(start + 3s); // the second step is for the other part's path
    other.advance(start + 1s);
    other.advance(start + 3s);
    EXPECT_EQ(one.generation(), 3U);
    EXPECT_EQ(one.generation(), other.generation());
    ASSERT_TRUE(set(all, "1-2", 5ms, start + 4s));
    const auto generation = all.generation();
    EXPECT_EQ(one.generation(), generation);
    EXPECT_EQ(other.generation(), generation);
    EXPECT_EQ(delay_of(all, "1-2"), 5ms);
    EXPECT_EQ(delay_of(all, "1-3"), 40ms);
    ASSERT_TRUE(set(all, "1-2", 5ms, start + 5s)); // as it is
    EXPECT_EQ(all.generation(), generation);
    EXPECT_EQ(all.deciders().size(), 2U);
    EXPECT_EQ(all.names().links.size(), 2U);
}

TEST(AllPaths, CountOnWhenAPartHasSlept)
{
    Paths one{parsed(steps), part({"1-3"})};
    Paths other{parsed(steps), part({"1-2"})};
    std::ignore = one.add("1-2");
    std::ignore = other.add("1-3");
    AllPaths all{{&one, &other}};
    one.advance(start + 1s);
    one.advance(start + 2s); // two steps, which the other part takes as one
    other.advance(start + 2s);
    EXPECT_EQ(all.generation(), 3U);
    ASSERT_TRUE(set(all, "1-3", 7ms, start + 2s));
    EXPECT_EQ(all.generation(), 4U);
    EXPECT_EQ(one.generation(), other.generation());
}

TEST(AllPaths, ChangeAtTheLatestTimeThatOneOfThemHasSeen)
{
    Paths one{parsed(steps), part({"1-3"})};
    Paths other{parsed(steps), part({"1-2"})};
    std::ignore = one.add("1-2");
    std::ignore = other.add("1-3");
    AllPaths all{{&one, &other}};
    other.advance(start + 500ms); // a datagram of the future, as one is stamped before it is seen
    ASSERT_TRUE(set(all, "", 7ms, start + 400ms));
    EXPECT_EQ(one.now(), start + 500ms);
    EXPECT_EQ(all.elapsed(), 500ms);
}

TEST(AllPaths, TellAClientWhatWasSetForItOnWhicheverPartItComes)
{
    const auto profile = parsed("both.delay = \"10ms\"\n");
    Paths one{profile, part({}, true)};
    Paths other{profile, part({}, true)};
    AllPaths all{{&one, &other}};
    ASSERT_TRUE(set(all, "client.2", 50ms, start));
    EXPECT_EQ(delay_of(one.add("client.1").director()), 10ms);
    EXPECT_EQ(delay_of(other.add("client.2").director()), 50ms);
    EXPECT_EQ(all.deciders().size(), 3U); // those, and future ones
    EXPECT_EQ(all.all().size(), 2U);
    ASSERT_TRUE(set(all, "client.2", 60ms, start + 1s));
    EXPECT_EQ(delay_of(all, "client.2"), 60ms);
    EXPECT_EQ(one.generation(), other.generation());
    EXPECT_FALSE(all.apply(
        [](std::string_view, const Path&) -> base::Result<Command> { return base::fail("no"); }, {},
        start + 2s));
    EXPECT_EQ(one.generation(), other.generation());
}

} // namespace
} // namespace hapnet::emulator::all_paths_test
