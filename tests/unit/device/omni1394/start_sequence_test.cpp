// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/omni1394/start_sequence.hpp"
#include "tests/support/omni1394/fake_omni.hpp"

#include <gtest/gtest.h>
#include <vector>

namespace hapnet::device::omni1394 {
namespace {

constexpr Channels channels{.to_device = 3, .to_host = 5};

/// Answers as the double does, until the sequence is over.
std::vector<std::uint64_t> run(StartSequence& sequence, FakeOmni& omni)
{
    std::vector<std::uint64_t> addresses;
    while (const auto access = sequence.next()) {
        addresses.push_back(access->address);
        if (access->writes) {
            EXPECT_TRUE(omni.write_register(access->address, access->to_write()));
            sequence.on_answer({});
        } else {
            sequence.on_answer(omni.read_register(access->address, access->size).value());
        }
        EXPECT_LT(addresses.size(), 20U);
    }
    return addresses;
}

TEST(OmniStart, AsksWhoItIsTellsTheChannelsAndLetsItStream)
{
    FakeOmni omni;
    StartSequence sequence{channels, true};
    EXPECT_EQ(run(sequence, omni),
              (std::vector<std::uint64_t>{0x1006000c, 0x10060010, 0x1000, 0x1001, 0x1001, 0x20010,
                                          0x1087, 0x1087}));
    EXPECT_TRUE(sequence.is_done());
    EXPECT_EQ(sequence.serial(), "70427300007");
    EXPECT_EQ(omni.read_register(0x1000, 1)->front(), std::byte{3});
    EXPECT_EQ(omni.read_register(0x1001, 1)->front(), std::byte{5});
    EXPECT_EQ(omni.read_register(0x1087, 1)->front(), std::byte{0x28}) << "other bits stay";
    EXPECT_EQ(omni.read_register(0x20010, 4),
              (std::vector{std::byte{0x00}, std::byte{0x00}, std::byte{0x0f}, std::byte{0xf8}}));
    EXPECT_TRUE(omni.is_streaming());
}

TEST(OmniStart, LeavesTheDubiousRegisterAloneWhereThatIsWanted)
{
    FakeOmni omni;
    StartSequence sequence{channels, false};
    for (const std::uint64_t address : run(sequence, omni)) EXPECT_NE(address, 0x20010U);
    EXPECT_TRUE(sequence.is_done());
}

TEST(OmniStart, StopsAtADeviceThatIsNoOmniBeforeItWritesAnything)
{
    StartSequence sequence{channels, true};
    ASSERT_FALSE(sequence.next()->writes);
    sequence.on_answer(std::vector<std::byte>(4, std::byte{0}));
    EXPECT_FALSE(sequence.next());
    EXPECT_FALSE(sequence.is_done());
    EXPECT_NE(sequence.failure().find("no PHANToM Omni"), std::string::npos);
}

TEST(OmniStart, StopsWhereTheDeviceDoesNotKeepItsChannelOrAnswersTooLittle)
{
    StartSequence forgetful{channels, true};
    FakeOmni omni;
    while (forgetful.next()->address != to_host_channel_register || forgetful.next()->writes) {
        const auto access = *forgetful.next();
        forgetful.on_answer(access.writes ? std::vector<std::byte>{}
                                          : *omni.read_register(access.address, access.size));
    }
    forgetful.on_answer(std::vector{std::byte{0}});
    EXPECT_FALSE(forgetful.next());
    EXPECT_EQ(forgetful.failure(), "it was told channel 5 and says 0");
    StartSequence short_of_words{channels, true};
    short_of_words.on_answer(std::vector<std::byte>(3));
    EXPECT_FALSE(short_of_words.next());
    EXPECT_FALSE(short_of_words.failure().empty());
}

TEST(OmniStart, EndsWithANoughtInTheControlRegister)
{
    EXPECT_EQ(stop_streaming().address, 0x1087U);
    EXPECT_EQ(stop_streaming().to_write().front(), std::byte{0});
}

} // namespace
} // namespace hapnet::device::omni1394
