// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/falcon/startup.hpp"

#include <algorithm>
#include <functional>
#include <gtest/gtest.h>

namespace hapnet::device::falcon {
namespace {

using Bytes = std::vector<std::byte>;

Bytes bytes(std::initializer_list<int> numbers)
{
    Bytes made;
    for (const int number : numbers) made.push_back(static_cast<std::byte>(number));
    return made;
}

Bytes firmware_of(std::size_t size)
{
    Bytes made(size);
    for (std::size_t i = 0; i < size; ++i) made[i] = static_cast<std::byte>(i % 251);
    return made;
}

Bytes report()
{
    const Packet packet = encode(Report{});
    return {packet.begin(), packet.end()};
}

/// A conversation: questions and commands are recorded, and a function gives the answers.
struct Conversation {
    std::vector<ChipRequest> asked;
    std::vector<Bytes> said;
    int steps = 0;

    /// `hears`: the answer to the last command; nullopt: silence.
    Step play(Startup startup, const std::function<std::optional<Bytes>(const Bytes&)>& hears)
    {
        for (; steps < 100'000; ++steps) {
            const Step step = startup.step();
            if (const auto* ask = std::get_if<ChipRequest>(&step)) {
                asked.push_back(*ask);
                startup.on_done();
            } else if (const auto* say = std::get_if<SendBytes>(&step)) {
                said.push_back(say->bytes);
                startup.on_done();
            } else if (std::holds_alternative<Listen>(step)) {
                const auto heard = hears(said.back());
                if (heard) {
                    startup.on_heard(*heard);
                } else {
                    startup.on_silence();
                }
            } else {
                return step;
            }
        }
        return Refused{};
    }
};

const Bytes hello = bytes({0x0a, 0x43, 0x0d});

/// A loader that works, and starts the firmware when it has all of it.
class Loader {
public:
    explicit Loader(std::size_t size) : left_{size} {}

    std::optional<Bytes> operator()(const Bytes& said)
    {
        if (is_greeting(said)) return left_ == 0 ? report() : Bytes{};
        if (said == hello) return bytes({0x00, 0x0a, 0x44, 0x2c, 0x0d});
        if (!is_fast_) {
            is_fast_ = true;
            return said;
        }
        left_ -= said.size();
        return said;
    }

private:
    static bool is_greeting(const Bytes& said) { return said.front() == std::byte{'<'}; }

    std::size_t left_;
    bool is_fast_ = false;
};

TEST(FalconStartup, LeavesAFirmwareAloneThatAnswers)
{
    Conversation conversation;
    const Step end =
        conversation.play(Startup{firmware_of(100)}, [](const Bytes&) { return report(); });
    EXPECT_TRUE(std::holds_alternative<Ready>(end));
    EXPECT_EQ(conversation.asked, (std::vector<ChipRequest>{{9, 1}, {3, 2}, {0, 1}, {0, 2}}));
    ASSERT_EQ(conversation.said.size(), 1U);
    EXPECT_TRUE(std::ranges::equal(conversation.said.front(), encode(Command{})));
}

TEST(FalconStartup, LoadsTheFirmwareAsTheDescriptionSays)
{
    Conversation conversation;
    const Step end = conversation.play(Startup{firmware_of(130)}, Loader{130});
    EXPECT_TRUE(std::holds_alternative<Ready>(end));
    EXPECT_EQ(conversation.asked, (std::vector<ChipRequest>{{9, 1},
                                                            {3, 2},
                                                            {0, 1},
                                                            {0, 2}, // is it running?
                                                            {0, 1},
                                                            {0, 2},
                                                            {9, 16},
                                                            {3, 0x4138},
                                                            {4, 8},
                                                            {2, 0},
                                                            {1, 0x0200},
                                                            {1, 0x0100},
                                                            {1, 0x0101},
                                                            {1, 0x0100},
                                                            {3, 0x0015},
                                                            {9, 1},
                                                            {3, 2},
                                                            {0, 1},
                                                            {0, 2}})); // now?
    const auto& said = conversation.said;
    ASSERT_EQ(said.size(), 10U + 1 + 1 + 3 + 1); // greetings, two hellos, chunks, a greeting
    EXPECT_EQ(said[10], hello);
    EXPECT_EQ(said[11], bytes({0x41}));
    EXPECT_EQ(said[12].size(), 62U);
    EXPECT_EQ(said[13].size(), 62U);
    EXPECT_EQ(said[14].size(), 6U);
}

TEST(FalconStartup, TakesAnEchoThatComesInPieces)
{
    Conversation conversation;
    Loader loader{130};
    Bytes rest;
    const Step end = conversation.play(Startup{firmware_of(130)}, [&](const Bytes& said) {
        if (rest.empty()) rest = *loader(said);
        const auto half = rest.begin() + static_cast<std::ptrdiff_t>((rest.size() + 1) / 2);
        Bytes piece{rest.begin(), half};
        rest.erase(rest.begin(), half);
        return std::optional{piece};
    });
    EXPECT_TRUE(std::holds_alternative<Ready>(end));
}

TEST(FalconStartup, SaysWhatIsMissingWhereThereIsNoFirmware)
{
    for (const auto& heard : {std::optional<Bytes>{}, std::optional{Bytes{}},
                              std::optional{bytes({0xff, 0x3c, 0x41})}}) {
        Conversation conversation;
        int count = 0;
        const Step end = conversation.play(Startup{{}}, [&](const Bytes&) {
            return heard && ++count % 2 == 0 ? std::optional{Bytes{}} : heard;
        });
        const auto* refused = std::get_if<Refused>(&end);
        ASSERT_NE(refused, nullptr);
        EXPECT_EQ(refused->error.fault, Fault::firmware_missing);
        EXPECT_NE(refused->error.message.find("--falcon-firmware FILE"), std::string::npos);
        EXPECT_NE(refused->error.message.find("Novint's"), std::string::npos);
        EXPECT_EQ(conversation.said.size(), 10U);
    }
}

TEST(FalconStartup, LoadsAgainWhenAnEchoIsWrongAndGivesUpAfterFiveTimes)
{
    for (const int wrong_ones : {1, 4, 5}) {
        Conversation conversation;
        Loader loader{130};
        int chunks = 0;
        int attempts = 0;
        bool is_fast = false;
        const Step end = conversation.play(Startup{firmware_of(130)}, [&](const Bytes& said) {
            if (said == hello) {
                is_fast = false;
                ++attempts;
                loader = Loader{130};
            }
            auto answer = *loader(said);
            if (said.size() == 1) is_fast = true;
            const bool is_chunk = is_fast && said.size() == 62;
            if (is_chunk && ++chunks > 0 && attempts <= wrong_ones) answer.back() ^= std::byte{1};
            return std::optional{answer};
        });
        if (wrong_ones < Startup::attempts_max) {
            EXPECT_TRUE(std::holds_alternative<Ready>(end)) << wrong_ones;
            EXPECT_EQ(attempts, wrong_ones + 1);
        } else {
            const auto* refused = std::get_if<Refused>(&end);
            ASSERT_NE(refused, nullptr);
            EXPECT_EQ(refused->error.fault, Fault::communication);
            EXPECT_EQ(attempts, Startup::attempts_max);
        }
    }
}

TEST(FalconStartup, EndsWhateverItHears)
{
    // A device that echoes everything is no Falcon, and neither is one that never stops sending.
    Conversation mirror;
    const Step with_mirror = mirror.play(Startup{firmware_of(130)}, [](const Bytes& said) {
        return Bytes{said.rbegin(), said.rend()};
    });
    EXPECT_TRUE(std::holds_alternative<Refused>(with_mirror));
    Conversation chatter;
    int count = 0;
    const Step with_chatter = chatter.play(Startup{firmware_of(130)}, [&](const Bytes&) {
        return ++count % 7 == 0 ? Bytes{} : Bytes(62, std::byte{0x55});
    });
    EXPECT_TRUE(std::holds_alternative<Refused>(with_chatter));
}

TEST(FalconStartup, SaysSoWhenTheChipTakesNoRequest)
{
    Startup startup{{}};
    ASSERT_TRUE(std::holds_alternative<ChipRequest>(startup.step()));
    startup.on_silence();
    const auto* refused = std::get_if<Refused>(&startup.step());
    ASSERT_NE(refused, nullptr);
    EXPECT_EQ(refused->error.fault, Fault::communication);
}

} // namespace
} // namespace hapnet::device::falcon
