// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/paths.hpp"

#include "emulator/core/profile/paths.hpp"
#include "emulator/core/profile/text.hpp"

#include <array>
#include <chrono>
#include <gtest/gtest.h>
#include <vector>

namespace hapnet::emulator::paths_test {
namespace {

using namespace std::chrono_literals;

const base::TimePoint start{100s};
constexpr QueueLimits few{.datagrams_max = 64, .bytes_max = 1 << 20};

Profile parsed(std::string_view text) { return parse_profile(text, "paths.toml", {}).value(); }

base::Duration delay_of(const EmulatedPath& path, Direction direction)
{
    return std::get<ConstantLaw>(path.link(direction).conditions().delay.law).value;
}

/// Sets the delay of all paths, or of one.
base::Result<void> set(Paths& paths, std::string_view only, base::Duration delay,
                       base::TimePoint now)
{
    std::vector<std::string> mentioned;
    if (!only.empty()) mentioned.emplace_back(only);
    return paths.apply(
        [&](std::string_view name, const Path&) -> base::Result<Command> {
            Patch patch;
            if (only.empty() || name == only) patch.delay = Variation{ConstantLaw{delay}, {}};
            return Set{patch, patch};
        },
        mentioned, now);
}

std::vector<Fate> fates_of(EmulatedPath& path, Direction direction, int count)
{
    std::vector<Fate> fates;
    const std::array<std::byte, 100> bytes{};
    for (int i = 0; i < count; ++i) {
        fates.push_back(path.on_packet(direction, bytes, start + i * 1ms).fate);
    }
    return fates;
}

TEST(Paths, ChangeTogetherAndCountAsOneGeneration)
{
    Paths paths{parsed("[both]\ndelay = \"10ms\"\n[link.\"2-1\"]\ndelay = \"20ms\"\n"
                       "[[at]]\ntime = \"1s\"\nall.delay = \"30ms\"\n"
                       "[[at]]\ntime = \"2s\"\nlink.1-3.delay = \"40ms\"\n"),
                {.start = start, .limits = few}};
    EmulatedPath& first = paths.add("1-2");
    EmulatedPath& second = paths.add("1-3");
    EXPECT_EQ(delay_of(first, Direction::up), 10ms);
    EXPECT_EQ(delay_of(first, Direction::down), 20ms);
    EXPECT_EQ(paths.next_change(), start + 1s);
    paths.advance(start + 1s - 1ns);
    EXPECT_EQ(paths.generation(), 1U);
    paths.advance(start + 1s);
    EXPECT_EQ(paths.generation(), 2U);
    EXPECT_EQ(delay_of(first, Direction::down), 30ms);
    EXPECT_EQ(delay_of(second, Direction::up), 30ms);
    paths.advance(start + 2s);
    EXPECT_EQ(paths.generation(), 3U);
    EXPECT_EQ(delay_of(first, Direction::up), 30ms);
    EXPECT_EQ(delay_of(second, Direction::up), 40ms);
    EXPECT_EQ(delay_of(second, Direction::down), 30ms);
    ASSERT_TRUE(set(paths, "1-2", 5ms, start + 3s));
    EXPECT_EQ(paths.generation(), 4U);
    EXPECT_EQ(delay_of(first, Direction::up), 5ms);
    EXPECT_EQ(delay_of(second, Direction::down), 30ms);
    ASSERT_TRUE(set(paths, "", 6ms, start + 3s));
    EXPECT_EQ(paths.generation(), 5U);
    ASSERT_TRUE(set(paths, "", 6ms, start + 4s));
    EXPECT_EQ(paths.generation(), 5U);
    EXPECT_EQ(delay_of(second, Direction::up), 6ms);
    EXPECT_EQ(paths.names().links, (std::vector<std::string>{"1-2", "1-3"}));
}

TEST(Paths, DrawFromTheirOwnStreamsWhateverTheOthersDo)
{
    const auto profile = parsed("[both]\nloss = \"50%\"\n");
    Paths together{profile, {.seed = base::Seed{7}, .start = start, .limits = few}};
    EmulatedPath& first = together.add("1-2");
    EmulatedPath& second = together.add("wan");
    const auto of_first = fates_of(first, Direction::up, 40);
    const auto of_second = fates_of(second, Direction::up, 40);
    EXPECT_NE(of_first, of_second);
    EXPECT_NE(of_first, fates_of(first, Direction::down, 40));
    Paths alone{profile, {.seed = base::Seed{7}, .start = start, .limits = few}};
    EXPECT_EQ(fates_of(alone.add("wan"), Direction::up, 40), of_second);
    LossProcess loss{RandomLoss{base::Probability::from_fraction(0.5).value()},
                     base::Seed{7}.stream("1-2/loss/random")};
    for (std::uint64_t n = 0; n < 40; ++n) {
        EXPECT_EQ(of_first[n].drop, loss.on_packet({n, 100, n * 1ms}));
    }
}

TEST(Paths, ThatComeLaterAreAsIfTheyHadBeenThere)
{
    Paths paths{parsed("[both]\ndelay = \"10ms\"\n[client.2]\ndelay = \"20ms\"\n"),
                {.start = start, .limits = few, .takes_newcomers = true}};
    ASSERT_TRUE(set(paths, "", 30ms, start + 1s));
    ASSERT_TRUE(set(paths, "client.3", 40ms, start + 2s));
    EXPECT_EQ(paths.generation(), 3U);
    EXPECT_EQ(delay_of(paths.add("client.1"), Direction::up), 30ms);
    EXPECT_EQ(delay_of(paths.add("client.2"), Direction::up), 30ms); // set by hand for all
    EXPECT_EQ(delay_of(paths.add("client.3"), Direction::up), 40ms);
    paths.remove("client.3");
    EXPECT_EQ(delay_of(paths.add("client.3"), Direction::up), 40ms);
    const auto reset = [](std::string_view, const Path&) -> base::Result<Command> {
        return Reset{};
    };
    ASSERT_TRUE(paths.apply(reset, {}, start + 3s));
    paths.remove("client.3");
    EXPECT_EQ(delay_of(paths.add("client.3"), Direction::up), 10ms);
    EXPECT_EQ(delay_of(paths.add("client.4"), Direction::up), 10ms);
    EXPECT_EQ(delay_of(*paths.all()[1].path, Direction::up), 20ms);
    for (std::size_t i = 0; i < Paths::absent_max; ++i) {
        const bool has_room = i + 1 < Paths::absent_max; // client.2 has one place
        EXPECT_EQ(set(paths, client_path(std::to_string(100 + i)), 1ms, start + 4s).has_value(),
                  has_room);
    }
}

TEST(Paths, KeepTheirOwnChanges)
{
    Paths paths{parsed("[[at]]\ntime = \"1s\"\nlink.\"1-2\".delay = \"20ms\"\n"),
                {.start = start, .limits = few, .changes_max = 2}};
    const EmulatedPath& first = paths.add("1-2");
    const EmulatedPath& second = paths.add("1-3");
    paths.advance(start + 1s);
    ASSERT_EQ(first.changes().entries().size(), 1U);
    EXPECT_EQ(first.changes().entries().front().by, ChangeCause::timeline);
    EXPECT_TRUE(first.changes().entries().front().patch(Direction::up).delay);
    EXPECT_TRUE(second.changes().entries().empty());
    ASSERT_TRUE(set(paths, "1-3", 30ms, start + 2s));
    EXPECT_EQ(first.changes().entries().size(), 1U);
    ASSERT_EQ(second.changes().entries().size(), 1U);
    EXPECT_EQ(second.changes().entries().front().elapsed, 2s);
    EXPECT_EQ(second.changes().entries().front().by, ChangeCause::hand);
    const auto again = [](std::string_view, const Path&) -> base::Result<Command> {
        return Apply{Profile{}};
    };
    ASSERT_TRUE(paths.apply(again, {}, start + 3s, ChangeCause::reload));
    ASSERT_EQ(second.changes().entries().size(), 2U);
    EXPECT_EQ(second.changes().entries().back().by, ChangeCause::reload);
    ASSERT_TRUE(set(paths, "", 40ms, start + 4s));
    EXPECT_EQ(second.changes().entries().size(), 2U);
    EXPECT_EQ(second.changes().omitted(), 1U);
    EXPECT_EQ(paths.generation(), 5U);
}

TEST(Paths, AreToldAllOrNone)
{
    Paths paths{Profile{}, {.start = start, .limits = few}};
    EmulatedPath& first = paths.add("1-2");
    paths.add("1-3");
    const auto command = [](std::string_view name, const Path&) -> base::Result<Command> {
        if (name == "1-3") return base::fail("no");
        Patch patch;
        patch.delay = Variation{ConstantLaw{1s}, {}};
        return Set{patch, patch};
    };
    const std::vector<std::string> mentioned{"1-3"};
    EXPECT_FALSE(paths.apply(command, mentioned, start + 1s));
    EXPECT_EQ(delay_of(first, Direction::up), 0s);
    EXPECT_EQ(paths.generation(), 1U);
    for (std::size_t i = 0; i <= Director::overrides_max; ++i) { // 1-3 takes no more of them
        const auto full = paths.apply(
            [&](std::string_view name, const Path&) -> base::Result<Command> {
                Patch patch;
                const auto delay = base::Duration{static_cast<std::int64_t>(i) + 1};
                if (name == "1-3") patch.delay = Variation{ConstantLaw{delay}, {}};
                return Set{patch, patch, 1h - i * 1s};
            },
            mentioned, start + 2s);
        EXPECT_EQ(full.has_value(), i < Director::overrides_max);
    }
}

TEST(Paths, GiveEachTheFatesOfItsName)
{
    auto fates = std::make_shared<FatesOfPaths>();
    (*fates)["1-2"].up = {Fate{.delay = 5ms}};
    Paths paths{Profile{}, {.start = start, .limits = few, .replay = fates}};
    EmulatedPath& first = paths.add("1-2");
    EmulatedPath& second = paths.add("1-3");
    EXPECT_EQ(fates_of(first, Direction::up, 1)[0].delay, 5ms);
    EXPECT_EQ(fates_of(first, Direction::down, 1)[0].drop, DropCause::replay_ended);
    EXPECT_EQ(fates_of(second, Direction::up, 1)[0].drop, DropCause::replay_ended);
}

TEST(Paths, HaveOneProfileThatIsToEachWhatItsOwnIs)
{
    const auto wide = parsed("[both]\ndelay = \"10ms\"\n[link.\"1-2\"]\nloss = \"1%\"\n"
                             "[[at]]\ntime = \"1s\"\nall.delay = \"30ms\"\n"
                             "[[at]]\ntime = \"1s\"\nlink.1-3.delay = \"40ms\"\n");
    std::vector<NamedProfile> each;
    for (const char* const name : {"1-2", "1-3", "2-3"}) {
        each.push_back({name, profile_of(wide, name)});
    }
    const Profile again = joined(each);
    EXPECT_EQ(parse_profile(to_text(again), "again", {}).value(), again);
    for (const auto& [name, own] : each) EXPECT_EQ(profile_of(again, name), own) << name;
    EXPECT_EQ(again, wide);
}

} // namespace
} // namespace hapnet::emulator::paths_test
