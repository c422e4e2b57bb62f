// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Conversations with any text from a client, cut into pieces in any way.
#include "proto/control/core/conversation.hpp"

#include "proto/base/random.hpp"
#include "tests/unit/emulator/control/emulation_fake.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

namespace hapnet::emulator {
namespace {

using namespace std::chrono_literals;

const base::TimePoint start{100s};

/// Draws numbers in turn from a stream.
class Dice {
public:
    explicit Dice(std::uint64_t seed) : stream_{base::Seed{seed}.stream("dice")} {}

    /// Below `n`.
    std::size_t below(std::size_t n)
    {
        return static_cast<std::size_t>(stream_.below(static_cast<std::uint32_t>(n), index_++));
    }

private:
    base::RandomStream stream_;
    std::uint64_t index_ = 0;
};

/// Draws a line: mostly a request that is valid or nearly valid.
std::string random_line(Dice& dice)
{
    constexpr std::array requests{
        R"({"command":"show"})",
        R"({"command":"reset"})",
        R"({"command":"stats"})",
        R"({"command":"set","settings":{"both.delay":"80ms"}})",
        R"({"command":"set","settings":{"up.delay":"7ms","down.loss":"3%"},"for":"30ms"})",
        R"({"command":"set","settings":{"up.jitter":"{ law = \"normal\", sd = \"3ms\" }"}})",
        R"({"command":"set","settings":{"both.burst_loss":"40/100"},"for":"1s"})",
        R"({"command":"apply","profile":"[up]\ndelay = \"9ms\"\n"})",
        R"({"command":"apply","profile":"[[at]]\ntime = \"50ms\"\nup.delay = \"1s\"\n"})",
        R"({"command":"diff","profile":"[down]\nloss = \"9%\"\n"})",
        R"({"command":"wait","until":"up.received>0","timeout":"10ms"})",
        R"({"command":"watch","every":"50ms"})",
    };
    std::string line = requests[dice.below(requests.size())];
    for (auto faults = dice.below(4); faults > 1; --faults) {
        line[dice.below(line.size())] = static_cast<char>(dice.below(256));
    }
    if (dice.below(8) == 0) line.resize(dice.below(line.size()));
    std::replace(line.begin(), line.end(), '\n', ' ');
    return line + "\n";
}

void expect_replies(const std::string& said, std::uint64_t seed)
{
    std::istringstream lines{said};
    for (std::string line; std::getline(lines, line);) {
        const auto reply = nlohmann::json::parse(line, nullptr, false);
        ASSERT_TRUE(reply.is_object()) << "seed " << seed << ": " << line;
        ASSERT_TRUE(reply["ok"].is_boolean()) << "seed " << seed << ": " << line;
        if (reply["ok"] == false) {
            EXPECT_TRUE(reply["error"].is_string());
        }
    }
}

TEST(Conversation, AnswersEachLineInTurnWithOneObjectAndNeverGoesBackAGeneration)
{
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        Dice dice{seed};
        EmulationFake fake{"[both]\ndelay = \"160ms\"\n", start};
        Conversation conversation;
        auto now = start;
        std::uint64_t generation = 1;
        std::string said;
        for (int i = 0; i < 50; ++i) {
            std::string line = random_line(dice);
            while (!line.empty()) {
                const auto piece = std::min(line.size(), 1 + dice.below(60));
                said += said_to(conversation, line.substr(0, piece), fake, now);
                line.erase(0, piece);
                now += std::chrono::microseconds{dice.below(5000)};
                fake.paths.advance(now);
                EXPECT_GE(fake.director().generation(), generation);
                generation = fake.director().generation();
            }
        }
        expect_replies(said, seed);
    }
}

TEST(Director, IsBackAtItsStartOnceEverythingMadeForATimeIsOver)
{
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        Dice dice{seed};
        EmulationFake fake{"[both]\ndelay = \"160ms\"\nloss = \"1%\"\n", start};
        const Path before = fake.director().path();
        constexpr std::array keys{"up.delay", "down.delay", "both.jitter", "up.burst_loss"};
        constexpr std::array values{"1ms", "2ms", "3ms", "4/10"};
        auto now = start;
        for (int i = 0; i < 30; ++i) {
            const auto key = dice.below(keys.size());
            const nlohmann::json request{
                {"command", "set"},
                {"settings", {{keys[key], key == 3 ? values[3] : values[dice.below(3)]}}},
                {"for", std::to_string(1 + dice.below(100)) + "ms"}};
            Conversation conversation;
            const auto said = said_to(conversation, request.dump() + "\n", fake, now);
            EXPECT_NE(said.find("\"ok\":true"), std::string::npos) << said;
            now += std::chrono::milliseconds{dice.below(20)};
        }
        fake.paths.advance(now + 100ms);
        EXPECT_EQ(fake.director().path(), before) << "seed " << seed;
        EXPECT_EQ(fake.director().next_change(), std::nullopt);
    }
}

} // namespace
} // namespace hapnet::emulator
