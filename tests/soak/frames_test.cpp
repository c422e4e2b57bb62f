// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// Floods of frames between two commands, both ways at once: every packet is in exactly one counter.
#include "tests/e2e/emulator.hpp"
#include "tests/e2e/process.hpp"
#include "tests/soak/traffic.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <utility>
#include <vector>

namespace hapnet::soak {

namespace {

struct Flooded {
    std::uint64_t sent_by_a = 0;
    std::uint64_t sent_by_b = 0;
    nlohmann::json statistics;
    std::uint64_t fates = 0;
};

std::uint64_t number_after(const std::string& words, const std::string& text)
{
    const auto at = text.find(words);
    return at == std::string::npos ? 0 : std::stoull(text.substr(at + words.size()));
}

class FrameFlood : public testing::Test {
protected:
    void SetUp() override
    {
        const auto trial = e2e::run("hapnet-emulator", {"between", "--", "true", "---", "true"});
        if (trial.exit == 3) GTEST_SKIP() << "no networks of one's own here: " << trial.err;
    }

    /// Both ends send at this rate; 0: as fast as they can. Expects the identity.
    static Flooded flooded(std::vector<std::string> conditions, std::int64_t per_second)
    {
        const auto seconds = std::max<std::int64_t>(3, setting("HAPNET_SOAK_ROW_SECONDS", 20) / 2);
        const auto rate = std::to_string(per_second);
        const auto length = std::to_string(seconds);
        const e2e::TemporaryFolder folder;
        const auto stats = folder.file("run.json");
        const auto fates = folder.file("fates.csv");
        const std::string end = HAPNET_BIN_DIR "/frame_flood";
        conditions.insert(conditions.begin(), "between");
        for (const std::string& word :
             {std::string{"--stats"}, stats, std::string{"--fates"}, fates, std::string{"--"}, end,
              std::string{"a"}, std::string{"b"}, rate, length, std::string{"---"}, end,
              std::string{"b"}, std::string{"a"}, rate, length}) {
            conditions.push_back(word);
        }
        const auto outcome =
            e2e::run("hapnet-emulator", conditions, std::chrono::seconds{3 * seconds + 60});
        // 1: packets are missing in --fates, which is said and counted.
        EXPECT_TRUE(outcome.exit == 0 || outcome.exit == 1) << outcome.err;
        Flooded result{number_after("a sent ", outcome.out), number_after("b sent ", outcome.out),
                       nlohmann::json::parse(e2e::text_of(stats)), 0};
        std::ifstream file{fates};
        result.fates = static_cast<std::uint64_t>(std::count(
            std::istreambuf_iterator<char>{file}, std::istreambuf_iterator<char>{}, '\n'));
        print(result);
        expect_all_counted(result);
        return result;
    }

    static std::uint64_t received(const nlohmann::json& way)
    {
        return way["received"].get<std::uint64_t>();
    }
    static std::uint64_t arrived(const nlohmann::json& way)
    {
        return received(way) + way["overflowed"].get<std::uint64_t>();
    }

private:
    static void print(const Flooded& result)
    {
        for (const auto& [name, sent] :
             {std::pair{"up", result.sent_by_a}, std::pair{"down", result.sent_by_b}}) {
            const auto& way = result.statistics[name];
            fmt::print("  {:4}: {} sent, {} received, {} overflowed, {} delivered, {} in flight\n",
                       name, sent, received(way), way["overflowed"].dump(), way["delivered"].dump(),
                       way["in_flight"].dump());
        }
    }

    static void expect_all_counted(const Flooded& result)
    {
        // Besides datagrams, the kernels send a few packets of IPv6.
        constexpr std::uint64_t others_max = 50;
        const auto& statistics = result.statistics;
        EXPECT_GT(result.sent_by_a, 0U);
        EXPECT_GT(result.sent_by_b, 0U);
        for (const char* name : {"up", "down"}) {
            e2e::expect_identity(statistics[name]);
            EXPECT_GT(statistics[name]["delivered"], 0);
        }
        EXPECT_LE(arrived(statistics["up"]), result.sent_by_a + others_max);
        EXPECT_LE(arrived(statistics["down"]), result.sent_by_b + others_max);
        for (const char* end : {"a", "b"}) EXPECT_EQ(statistics["frames"][end]["oversized"], 0);
        EXPECT_EQ(result.fates + statistics["fates_lost"].get<std::uint64_t>(),
                  received(statistics["up"]) + received(statistics["down"]) + 1);
    }
};

} // namespace

/// Both ends send as fast as they can, under every kind of condition, and through a link too narrow
/// for it.
TEST_F(FrameFlood, OfWhatBothEndsCanSendIsCounted)
{
    const auto result =
        flooded({"--delay", "20ms", "--jitter", "5ms", "--order", "free", "--loss", "2%",
                 "--duplicate", "3%", "--corrupt", "1%", "--reorder",
                 "{ share = \"1%\", displacement = 3 }", "--mtu", "1400B", "--up.rate", "50Mbit/s"},
                0);
    const auto& up = result.statistics["up"];
    EXPECT_GT(up["dropped"]["rate_queue_full"], 0);
    EXPECT_GT(up["dropped"]["mtu"], 0);
    EXPECT_GT(up["duplicated"], 0);
    EXPECT_GT(up["corrupted"], 0);
}

/// More than the memory in flight holds.
TEST_F(FrameFlood, OfMoreThanTheMemoryHoldsIsCounted)
{
    const auto result = flooded({"--delay", "500ms", "--in-flight", "4MiB"}, 0);
    EXPECT_GT(result.statistics["up"]["dropped"]["queue_full"], 0);
}

/// A rate that the emulator can take: nothing is missing.
TEST_F(FrameFlood, AStreamThatItCanTakeArrivesWhole)
{
    const auto result = flooded({"--delay", "20ms"}, 5000);
    EXPECT_GE(arrived(result.statistics["up"]), result.sent_by_a);
    EXPECT_GE(arrived(result.statistics["down"]), result.sent_by_b);
    for (const char* name : {"up", "down"}) {
        EXPECT_EQ(result.statistics[name]["delivered"], result.statistics[name]["received"]);
    }
}

} // namespace hapnet::soak
