// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/abi/hapnet_link.h"

#include "emulator/core/emulated_path.hpp"
#include "emulator/core/profile/text.hpp"

#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace {

using namespace hapnet;
using namespace std::chrono_literals;

constexpr std::int64_t ms = 1'000'000;

struct Destroy {
    void operator()(hapnet_link* link) const { hapnet_link_destroy(link); }
};
using LinkPointer = std::unique_ptr<hapnet_link, Destroy>;

std::string why_refused(const char* profile)
{
    std::array<char, 512> error{};
    const LinkPointer link{hapnet_link_create(profile, 1, error.data(), error.size())};
    return link ? "it was taken" : error.data();
}

LinkPointer link_of(const std::string& profile, std::uint64_t seed = 1)
{
    std::array<char, 512> error{};
    LinkPointer link{hapnet_link_create(profile.c_str(), seed, error.data(), error.size())};
    EXPECT_NE(link, nullptr) << error.data();
    return link;
}

/// Returns the text that a function writes into a buffer of the size that it asks for.
std::string text_of(std::size_t (*write)(const hapnet_link*, char*, std::size_t),
                    const hapnet_link* link)
{
    std::string text(write(link, nullptr, 0) + 1, '?');
    text.resize(write(link, text.data(), text.size()));
    return text;
}

TEST(HapnetLink, LetsAPacketLeaveAfterItsDelayWithTheBytesThatItHad)
{
    const auto link = link_of("up.delay = \"40ms\"");
    EXPECT_EQ(hapnet_link_next_deadline(link.get()), HAPNET_LINK_NEVER);
    EXPECT_EQ(hapnet_link_push(link.get(), HAPNET_LINK_UP, "hello", 5, 3 * ms), 0);
    EXPECT_EQ(hapnet_link_next_deadline(link.get()), 43 * ms);
    std::array<char, 8> bytes{};
    hapnet_link_packet packet{};
    EXPECT_EQ(hapnet_link_pop(link.get(), 43 * ms - 1, bytes.data(), bytes.size(), &packet), 0);
    ASSERT_EQ(hapnet_link_pop(link.get(), 50 * ms, bytes.data(), bytes.size(), &packet), 1);
    EXPECT_EQ(std::string_view(bytes.data(), packet.size), "hello");
    EXPECT_EQ(packet.direction, HAPNET_LINK_UP);
    EXPECT_EQ(packet.arrived_ns, 3 * ms);
    EXPECT_EQ(packet.due_ns, 43 * ms);
    EXPECT_EQ(hapnet_link_pop(link.get(), 50 * ms, bytes.data(), bytes.size(), &packet), 0);
}

TEST(HapnetLink, KeepsAPacketForALargerBuffer)
{
    for (const char* const profile : {"", "up.delay = \"1ms\""}) {
        const auto link = link_of(profile);
        hapnet_link_push(link.get(), HAPNET_LINK_UP, "hello", 5, 0);
        std::array<char, 5> bytes{};
        hapnet_link_packet packet{};
        ASSERT_EQ(hapnet_link_pop(link.get(), ms, bytes.data(), 4, &packet), -1) << profile;
        EXPECT_EQ(packet.size, 5U);
        EXPECT_LE(hapnet_link_next_deadline(link.get()), ms);
        EXPECT_EQ(hapnet_link_pop(link.get(), ms, bytes.data(), 5, nullptr), 1);
        EXPECT_EQ(std::string_view(bytes.data(), 5), "hello");
        EXPECT_EQ(hapnet_link_next_deadline(link.get()), HAPNET_LINK_NEVER);
    }
}

TEST(HapnetLink, GivesTheEarliestOfBothDirectionsFirst)
{
    const auto link = link_of("up.delay = \"40ms\"\ndown.delay = \"10ms\"");
    hapnet_link_push(link.get(), HAPNET_LINK_UP, "u", 1, 0);
    hapnet_link_push(link.get(), HAPNET_LINK_DOWN, "d", 1, 5 * ms);
    hapnet_link_push(link.get(), HAPNET_LINK_DOWN, "e", 1, 35 * ms);
    std::string order;
    char byte = 0;
    while (hapnet_link_pop(link.get(), 100 * ms, &byte, 1, nullptr) == 1) order += byte;
    EXPECT_EQ(order, "due");
}

TEST(HapnetLink, LetsWhatNothingHoldsLeaveBeforeWhatComesLater)
{
    const auto link = link_of("up.delay = \"0ms\"\n[[at]]\ntime = \"1ms\"\nup.delay = \"1ms\"");
    hapnet_link_push(link.get(), HAPNET_LINK_UP, "a", 1, 0);
    hapnet_link_push(link.get(), HAPNET_LINK_UP, "b", 1, 0);
    hapnet_link_push(link.get(), HAPNET_LINK_UP, "c", 1, 2 * ms);
    EXPECT_EQ(hapnet_link_next_deadline(link.get()), 0);
    std::string order;
    char byte = 0;
    while (hapnet_link_pop(link.get(), 9 * ms, &byte, 1, nullptr) == 1) order += byte;
    EXPECT_EQ(order, "abc");
}

TEST(HapnetLink, NamesTheCauseOfADrop)
{
    const auto link = link_of("up.loss = \"100%\"");
    const int cause = hapnet_link_push(link.get(), HAPNET_LINK_UP, "x", 1, 0);
    EXPECT_STREQ(hapnet_link_cause(cause), "random_loss");
    EXPECT_EQ(text_of(hapnet_link_fate, link.get()), "up,0,drop,random_loss,,,,,,\n");
    EXPECT_EQ(hapnet_link_cause(0), nullptr);
    EXPECT_EQ(hapnet_link_cause(-1), nullptr);
    EXPECT_EQ(hapnet_link_cause(1000), nullptr);
}

TEST(HapnetLink, RefusesWhatIsNoPacket)
{
    const auto link = link_of("");
    const std::vector<char> large(HAPNET_LINK_PACKET_MAX + 1);
    EXPECT_EQ(hapnet_link_push(link.get(), 2, "x", 1, 0), -1);
    EXPECT_EQ(hapnet_link_push(link.get(), HAPNET_LINK_UP, large.data(), large.size(), 0), -1);
    EXPECT_EQ(hapnet_link_push(link.get(), HAPNET_LINK_UP, large.data(), large.size() - 1, 0), 0);
    EXPECT_EQ(hapnet_link_push(link.get(), HAPNET_LINK_UP, nullptr, 0, 0), 0);
}

TEST(HapnetLink, TakesAnEarlierTimeForTheLatest)
{
    const auto link = link_of("up.delay = \"1ms\"");
    hapnet_link_push(link.get(), HAPNET_LINK_UP, "a", 1, 5 * ms);
    hapnet_link_push(link.get(), HAPNET_LINK_UP, "b", 1, 2 * ms);
    char byte = 0;
    hapnet_link_packet packet{};
    hapnet_link_pop(link.get(), 9 * ms, &byte, 1, &packet);
    hapnet_link_pop(link.get(), 9 * ms, &byte, 1, &packet);
    EXPECT_EQ(packet.arrived_ns, 5 * ms);
}

TEST(HapnetLink, SetsOneConditionFromNowOn)
{
    const auto link = link_of("both.delay = \"1ms\"");
    std::array<char, 256> error{};
    hapnet_link_push(link.get(), HAPNET_LINK_UP, "a", 1, 0);
    ASSERT_EQ(hapnet_link_set(link.get(), "up.delay", "200ms", 5 * ms, error.data(), error.size()),
              0)
        << error.data();
    hapnet_link_push(link.get(), HAPNET_LINK_UP, "b", 1, 5 * ms);
    char byte = 0;
    ASSERT_EQ(hapnet_link_pop(link.get(), 5 * ms, &byte, 1, nullptr), 1);
    EXPECT_EQ(hapnet_link_next_deadline(link.get()), 205 * ms);
    EXPECT_EQ(hapnet_link_set(link.get(), "up.dealy", "1ms", 6 * ms, error.data(), error.size()),
              -1);
    EXPECT_STREQ(error.data(), "unknown key 'up.dealy': did you mean 'up.delay'?");
    EXPECT_EQ(hapnet_link_set(link.get(), "up.delay", R"({ law = "trace", file = "x.csv" })",
                              6 * ms, error.data(), error.size()),
              -1);
    EXPECT_NE(std::strstr(error.data(), "in a profile alone"), nullptr) << error.data();
}

TEST(HapnetLink, SaysWhyAProfileIsRefused)
{
    EXPECT_EQ(why_refused("[both]\ndely = \"5ms\""),
              "profile:2:1: unknown key 'dely': did you mean 'delay'?");
    EXPECT_NE(why_refused("letx").find("there is neither a file nor a preset 'letx'"),
              std::string::npos);
    EXPECT_NE(why_refused("up.delay = { law = \"trace\", file = \"a.csv\" }")
                  .find("hapnet_link_create_in"),
              std::string::npos);
    EXPECT_EQ(why_refused("[[flow]]\nname = \"voice\"\nmatch = { port = 5004 }\n"
                          "both.delay = \"1ms\""),
              "a link is one path and takes no [[flow]]: make a link for each flow");
    EXPECT_EQ(why_refused("lte"), "it was taken");
    std::array<char, 8> small{};
    EXPECT_EQ(hapnet_link_create("[both", 1, small.data(), small.size()), nullptr);
    EXPECT_EQ(std::strlen(small.data()), 7U);
    EXPECT_EQ(hapnet_link_create("[both", 1, nullptr, 0), nullptr);
}

TEST(HapnetLink, ReadsFilesBelowItsFolderAlone)
{
    const auto folder = std::filesystem::path{testing::TempDir()} / "hapnet_link";
    std::filesystem::create_directories(folder);
    std::ofstream{folder / "delays.csv"} << "time_s,delay_ms\n0.0,30\n1.0,50\n";
    const auto create = [&](const char* file, auto&& error) {
        const std::string profile =
            std::string{"up.delay = { law = \"trace\", file = \""} + file + "\" }";
        return LinkPointer{
            hapnet_link_create_in(profile.c_str(), folder.c_str(), 1, error.data(), error.size())};
    };
    std::array<char, 256> error{};
    EXPECT_NE(create("delays.csv", error), nullptr) << error.data();
    EXPECT_EQ(create("../delays.csv", error), nullptr);
    EXPECT_NE(std::strstr(error.data(), "not below the folder"), nullptr) << error.data();
    EXPECT_EQ(hapnet_link_create_in("", "/nonexistent", 1, error.data(), error.size()), nullptr);
    EXPECT_NE(std::strstr(error.data(), "/nonexistent"), nullptr) << error.data();
}

TEST(HapnetLink, TellsItsStatisticsWithTheKeysOfTheDaemon)
{
    const auto link = link_of("up.delay = \"1ms\"\nup.loss = { law = \"every\", every = 2 }");
    for (int i = 0; i < 10; ++i) hapnet_link_push(link.get(), HAPNET_LINK_UP, "x", 1, i * ms);
    char byte = 0;
    while (hapnet_link_pop(link.get(), 5 * ms, &byte, 1, nullptr) == 1) {}
    const auto told = nlohmann::json::parse(text_of(hapnet_link_statistics, link.get()));
    const auto& up = told.at("up");
    EXPECT_EQ(up.at("received"), 10);
    EXPECT_EQ(up.at("dropped").at("periodic_loss"), 5);
    EXPECT_EQ(10, up.at("delivered").get<int>() + up.at("in_flight").get<int>() + 5);
    EXPECT_EQ(told.at("down").at("received"), 0);
    std::array<char, 4> small{};
    EXPECT_GT(hapnet_link_statistics(link.get(), small.data(), small.size()), small.size());
    EXPECT_STREQ(small.data(), "{\"u");
}

/// Conditions of every law, those that depend on time among them.
constexpr std::array profiles{
    R"(up.delay = { law = "normal", mean = "20ms", sd = "5ms" })",
    R"(up.jitter = { law = "gamma", mean = "5ms", sd = "3ms", correlation_time = "10ms" })",
    R"(up.jitter = { law = "uniform", half_width = "5ms" }
up.delay = "40ms"
up.order = "free")",
    R"(up.jitter = { law = "exponential", mean = "5ms" }
up.order = "sorted")",
    R"(up.jitter = { law = "pareto", mean = "5ms" })",
    R"(up.jitter = { law = "log-normal", mean = "5ms", sd = "4ms" })",
    R"(up.loss = ["2%", "40/100"])",
    R"(up.loss = { law = "gilbert-elliott", good_to_bad = "1%", bad_to_good = "25%" })",
    R"(up.loss = { law = "timed-burst", lost = "50ms", every = "1s" })",
    R"(up.loss = [{ law = "timed-gilbert-elliott", mean_good = "1s", mean_bad = "200ms" },
    { law = "four-state", share = "2%", burst = 8.0, density = "80%", isolated = "0.1%" },
    { law = "list", numbers = [3, 17] }, { law = "pattern", pattern = "0001" },
    { law = "outage", windows = [["2s", "3s"]] }, { law = "every", every = 100 }])",
    R"(up.loss = { law = "burst", lost = 4, of = 100 })",
    R"(up.corrupt = { share = "5%", bits = 3 }
up.duplicate = { share = "5%", spread = "3ms" }
up.reorder = { share = "5%", displacement = 3 })",
    R"(up.rate = "2Mbit/s"
up.delay = "10ms"
[[at]]
time = "3s"
ramp = "2s"
up.delay = "60ms")",
};

TEST(HapnetLink, DrawsTheFatesOfThePathThatTheDaemonHas)
{
    constexpr int packets = 78'000; // a million in all
    for (const char* const text : profiles) {
        const auto profile = emulator::parse_profile(text, "profile", {});
        ASSERT_TRUE(profile) << profile.error().message;
        emulator::EmulatedPath path{*profile, {.seed = base::Seed{7}}};
        const auto link = link_of(text, 7);
        const std::array<std::byte, 96> bytes{};
        std::string expected;
        std::array<char, 256> told{};
        std::vector<char> out(HAPNET_LINK_PACKET_MAX);
        std::int64_t now = 0;
        for (int i = 0; i < packets; ++i, now += 137'000) {
            const base::TimePoint at{base::Duration{now}};
            while (base::is_due(path.director().next_change(), at)) {
                path.advance(*path.director().next_change());
            }
            const auto admission = path.on_packet(emulator::Direction::up, bytes, at);
            while (const auto datagram = path.poll(emulator::Direction::up, at)) {
                path.on_sent(emulator::Direction::up, *datagram, at);
            }
            expected.clear();
            append_row(expected, emulator::Direction::up, admission.number, admission.fate);
            hapnet_link_push(link.get(), HAPNET_LINK_UP, bytes.data(), bytes.size(), now);
            const auto size = hapnet_link_fate(link.get(), told.data(), told.size());
            ASSERT_EQ(std::string_view(told.data(), size), expected) << text << ", packet " << i;
            while (hapnet_link_pop(link.get(), now, out.data(), out.size(), nullptr) == 1) {}
        }
    }
}

} // namespace
