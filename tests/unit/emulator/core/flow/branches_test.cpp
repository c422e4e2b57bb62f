// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/flow/branches.hpp"

#include "emulator/core/paths.hpp"
#include "emulator/core/profile/text.hpp"

#include <array>
#include <chrono>
#include <gtest/gtest.h>
#include <tuple>
#include <vector>

namespace hapnet::emulator::branches_test {
namespace {

using namespace std::chrono_literals;

const base::TimePoint begin{100s};
constexpr QueueLimits limits{.datagrams_max = 256, .bytes_max = 1 << 20};
constexpr std::array<std::byte, 972> thousand{}; // bytes, with the 28 of IP and UDP

Profile profile_of_text(std::string_view text)
{
    const auto profile = parse_profile(text, "flows.toml", {});
    EXPECT_TRUE(profile) << profile.error().message;
    return profile.value_or(Profile{});
}

/// A flow on port 5004 and above.
std::string flow(int number, std::string_view lines)
{
    return fmt::format("[[flow]]\nname = \"f{}\"\nmatch = {{ port = {} }}\n{}\n", number,
                       5004 + number, lines);
}

std::vector<Fate> fates_of(EmulatedPath& path, int count)
{
    std::vector<Fate> fates;
    for (int i = 0; i < count; ++i) {
        fates.push_back(path.on_packet(Direction::up, thousand, begin + i * 1ms).fate);
    }
    return fates;
}

/// The departures of all datagrams in flight, by the number of the path and in that order.
std::vector<std::pair<std::size_t, base::Duration>> departures(Paths& paths)
{
    std::vector<std::pair<std::size_t, base::Duration>> left;
    for (int turns = 0; paths.next_due() && turns < 1000; ++turns) {
        const auto now = *paths.next_due();
        paths.each_due(now, [&](std::size_t number) {
            EmulatedPath& path = paths.at(number);
            while (const auto datagram = path.poll(Direction::up, now)) {
                left.emplace_back(number, datagram->due - begin);
                path.on_sent(Direction::up, *datagram, now);
            }
        });
    }
    return left;
}

void expect_identity(const EmulatedPath& path)
{
    const Statistics& s = path.link(Direction::up).statistics();
    EXPECT_EQ(s.received + s.duplicated, s.delivered + s.dropped_total() + s.in_flight);
}

TEST(Branches, GiveEachFlowAPathOfItsOwn)
{
    Paths paths{profile_of_text("[both]\ndelay = \"20ms\"\n" + flow(0, "up.delay = \"80ms\"") +
                                flow(1, "pass = true")),
                {.start = begin, .limits = limits}};
    EmulatedPath& rest = paths.add("");
    ASSERT_NE(rest.branches(), nullptr);
    const auto flows = rest.branches()->paths();
    ASSERT_EQ(flows.size(), 2U);
    std::ignore = rest.on_packet(Direction::up, thousand, begin);
    std::ignore = flows[0]->on_packet(Direction::up, thousand, begin);
    EXPECT_TRUE(flows[1]->on_packet(Direction::up, thousand, begin).departure);
    const std::vector<std::pair<std::size_t, base::Duration>> expected{{rest.number(), 20ms},
                                                                       {flows[0]->number(), 80ms}};
    EXPECT_EQ(departures(paths), expected);
    EXPECT_EQ(paths.names().flows, (std::vector<std::string>{"f0", "f1"}));
    EXPECT_TRUE(paths.names().links.empty());
}

TEST(Branches, KnowWhichFlowAPacketBelongsTo)
{
    Paths paths{profile_of_text(flow(0, "") + flow(1, "")), {.start = begin, .limits = limits}};
    Branches& branches = *paths.add("").branches();
    PacketFacts facts{.protocol = 17, .version = 4, .has_ports = true, .to_port = 5005};
    EXPECT_EQ(branches.flow_of(facts, begin), 1U);
    facts.to_port = 80;
    EXPECT_EQ(branches.flow_of(facts, begin), std::nullopt);
    EXPECT_EQ(branches.flow_of(std::nullopt, begin), std::nullopt);
}

TEST(Branches, DrawTheFatesOfAFlowWhateverTheOthersAre)
{
    const std::string lossy = "up.loss = \"50%\"\nup.jitter = \"5ms\"";
    Paths one{profile_of_text(flow(0, lossy)), {.start = begin, .limits = limits}};
    Paths more{profile_of_text("[up]\nloss = \"50%\"\njitter = \"5ms\"\n" + flow(1, lossy) +
                               flow(0, lossy)),
               {.start = begin, .limits = limits}};
    EmulatedPath& alone = *one.add("").branches()->paths()[0];
    EmulatedPath& rest = more.add("");
    EmulatedPath& other = *rest.branches()->paths()[0];
    EmulatedPath& same = *rest.branches()->paths()[1];
    const auto fates = fates_of(alone, 100);
    EXPECT_NE(fates_of(other, 100), fates);
    EXPECT_NE(fates_of(rest, 100), fates);
    EXPECT_EQ(fates_of(same, 100), fates);
}

TEST(Branches, LeaveTheRestAsItWasWithoutThem)
{
    const std::string own = "[up]\nloss = \"50%\"\njitter = \"5ms\"\n";
    Paths without{profile_of_text(own), {.start = begin, .limits = limits}};
    Paths with{profile_of_text(own + flow(0, "up.loss = \"10%\"")),
               {.start = begin, .limits = limits}};
    EXPECT_EQ(fates_of(with.add(""), 100), fates_of(without.add(""), 100));
}

TEST(Branches, MayShareTheRateOfTheRestAndKeepTheirOwnDelay)
{
    // A thousand bytes take 8 ms at 1 Mbit/s.
    Paths paths{profile_of_text("[up]\nrate = \"1Mbit/s\"\n" +
                                flow(0, "rate = \"shared\"\nup.delay = \"100ms\"")),
                {.start = begin, .limits = limits}};
    EmulatedPath& rest = paths.add("");
    EmulatedPath& shared = *rest.branches()->paths()[0];
    std::ignore = rest.on_packet(Direction::up, thousand, begin);
    std::ignore = shared.on_packet(Direction::up, thousand, begin);
    std::ignore = rest.on_packet(Direction::up, thousand, begin);
    std::ignore = shared.on_packet(Direction::up, thousand, begin);
    const std::vector<std::pair<std::size_t, base::Duration>> expected{{rest.number(), 8ms},
                                                                       {rest.number(), 24ms},
                                                                       {shared.number(), 116ms},
                                                                       {shared.number(), 132ms}};
    EXPECT_EQ(departures(paths), expected);
    EXPECT_EQ(shared.link(Direction::up).statistics().sojourn.count(), 2U);
    EXPECT_EQ(rest.link(Direction::up).statistics().sojourn.count(), 2U);
    expect_identity(rest);
    expect_identity(shared);
}

TEST(Branches, CountWhatTheSharedQueueDropsWhereItBelongs)
{
    Paths paths{profile_of_text("[up]\nrate = { limit = \"1Mbit/s\", queue = \"2kB\" }\n" +
                                flow(0, "rate = \"shared\"")),
                {.start = begin, .limits = limits}};
    EmulatedPath& rest = paths.add("");
    EmulatedPath& shared = *rest.branches()->paths()[0];
    for (int i = 0; i < 3; ++i) std::ignore = rest.on_packet(Direction::up, thousand, begin);
    std::ignore = shared.on_packet(Direction::up, thousand, begin);
    const auto& dropped = shared.link(Direction::up).statistics().dropped;
    EXPECT_EQ(dropped[DropCause::rate_queue_full], 1U);
    EXPECT_EQ(rest.link(Direction::up).statistics().dropped_total(), 0U);
    std::ignore = shared.on_packet(Direction::up, thousand, begin + 8ms); // one has left
    EXPECT_EQ(departures(paths).size(), 4U);
    expect_identity(shared);
    EXPECT_EQ(shared.link(Direction::up).statistics().delivered, 1U);
}

TEST(Branches, FollowARateOfTheRestThatChanges)
{
    Paths paths{profile_of_text("[up]\nrate = \"1Mbit/s\"\n" + flow(0, "rate = \"shared\"") +
                                "[[at]]\ntime = \"4ms\"\nup.rate = \"2Mbit/s\"\n"),
                {.start = begin, .limits = limits}};
    EmulatedPath& shared = *paths.add("").branches()->paths()[0];
    std::ignore = shared.on_packet(Direction::up, thousand, begin);
    paths.advance(begin + 4ms);
    const std::vector<std::pair<std::size_t, base::Duration>> expected{{shared.number(), 6ms}};
    EXPECT_EQ(departures(paths), expected);
}

TEST(Branches, AreToldByTheirNamesAlsoOfClientsThatCome)
{
    Paths paths{profile_of_text("[both]\ndelay = \"20ms\"\n" + flow(0, "up.delay = \"80ms\"") +
                                "[client.2.flow.f0]\nup.delay = \"90ms\"\n"),
                {.start = begin, .limits = limits, .takes_newcomers = true}};
    EmulatedPath& first = paths.add("client.1");
    const auto delay_of = [](const EmulatedPath& path) {
        return path.link(Direction::up).conditions().delay;
    };
    const auto set = [&](std::string_view which, base::Duration delay) {
        const std::vector<std::string> mentioned{std::string{which}};
        return paths.apply(
            [&](std::string_view name, const Path&) -> base::Result<Command> {
                Patch patch;
                if (name == which || common_name(name) == which) patch.delay = constant(delay);
                return Set{patch, {}};
            },
            mentioned, begin);
    };
    EXPECT_TRUE(set("flow.f0", 200ms));
    EXPECT_TRUE(set("client.3.flow.f0", 300ms));
    EXPECT_EQ(delay_of(*first.branches()->paths()[0]), constant(200ms));
    EXPECT_EQ(delay_of(first), constant(20ms));
    EXPECT_EQ(delay_of(*paths.add("client.3").branches()->paths()[0]), constant(300ms));
    EXPECT_EQ(delay_of(*paths.add("client.4").branches()->paths()[0]), constant(200ms));
    paths.remove("client.4");
    EXPECT_EQ(paths.all().size(), 4U);
}

TEST(Branches, PutArrivalsOfFlowsInOneOrder)
{
    Branches branches{std::make_shared<const FlowFilters>(std::vector<Match>{}), {}};
    EXPECT_EQ(branches.in_order(Direction::up, begin + 2ms), begin + 2ms);
    EXPECT_EQ(branches.in_order(Direction::up, begin + 1ms), begin + 2ms);
    EXPECT_EQ(branches.in_order(Direction::down, begin + 1ms), begin + 1ms);
}

} // namespace
} // namespace hapnet::emulator::branches_test
