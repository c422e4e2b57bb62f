// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/records/replay.hpp"

#include "peer/core/sync/text.hpp"
#include "tests/unit/lab/records/recorded_pair.hpp"

#include <algorithm>

namespace hapnet::lab {
namespace {

double strongest(const Replayed& replayed)
{
    double most = 0.0;
    for (const ReplayedTick& tick : replayed.ticks) most = std::max(most, base::norm(tick.device));
    return most;
}

TEST(ReplayOfARecord, GivesTheForcesThatWereRecorded)
{
    const auto replayed = replay(RecordedPair{}.play(4000), std::nullopt);
    ASSERT_TRUE(replayed.has_value()) << replayed.error().message;
    EXPECT_EQ(replayed->ticks.size(), 4000U);
    EXPECT_FALSE(replayed->differs_from);
    EXPECT_EQ(replayed->contact_difference_max_n, 0.0);
    EXPECT_EQ(replayed->device_difference_max_n, 0.0);
    EXPECT_GT(strongest(*replayed), 0.5);
}

TEST(ReplayOfARecord, RendersContactsAsSoftlyAsTheDeviceDidAndFullyWhereTheRecordIsOlder)
{
    RecordedPair pair;
    pair.render_at_most(250.0); // of a contact's 500
    record::Record record = pair.play(4000);
    const auto replayed = replay(record, std::nullopt);
    ASSERT_TRUE(replayed.has_value()) << replayed.error().message;
    EXPECT_EQ(replayed->contact_difference_max_n, 0.0);
    EXPECT_EQ(replayed->device_difference_max_n, 0.0);
    record.config.erase("stiffness_max_n_per_m");
    EXPECT_GT(replay(record, std::nullopt).value().contact_difference_max_n, 0.5);
    record.config["stiffness_max_n_per_m"] = -1.0;
    EXPECT_FALSE(replay(record, std::nullopt).has_value());
}

TEST(ReplayOfARecord, NoticesAMessageThatWasNotTheRecordedOne)
{
    const record::Record record = RecordedPair{}.play(2500);
    for (const bool lost : {true, false}) {
        record::Record other = record;
        const auto found = std::ranges::find(other.messages, 2000U, &record::MessageRow::tick);
        ASSERT_NE(found, other.messages.end());
        if (lost) {
            other.messages.erase(found);
        } else {
            auto state = std::get<wire::State>(wire::decode(found->datagram()).value());
            state.contact_force.value.x += 0.01;
            std::ranges::copy(wire::encode(state).bytes(), found->bytes.begin());
        }
        const auto replayed = replay(other, std::nullopt);
        ASSERT_TRUE(replayed.has_value());
        EXPECT_EQ(replayed->differs_from, std::optional<std::uint64_t>{2000}) << lost;
        EXPECT_EQ(to_json(*replayed)["reproduced"], false);
    }
}

TEST(ReplayOfARecord, NoticesASampleThatWasNotTheRecordedOne)
{
    const record::Record record = RecordedPair{}.play(2500);
    const std::vector<std::function<void(record::TickRow&)>> changes{
        [](record::TickRow& row) { row.hip.value.x += 1e-8; },
        [](record::TickRow& row) { row.hip_velocity.value.x += 1e-6; },
        [](record::TickRow& row) { row.docked = true; },
        [](record::TickRow& row) { row.calibrated = false; },
        [](record::TickRow& row) { row.fault = static_cast<std::uint8_t>(device::Fault::timeout); },
        [](record::TickRow& row) { row.hip_velocity.value.y = 1.1; },
        [](record::TickRow& row) { row.late += std::chrono::milliseconds{30}; },
        [](record::TickRow& row) { row.contact.value.y += 1e-8; },
        [](record::TickRow& row) { row.device.value.z -= 1e-8; },
    };
    for (std::size_t i = 0; i < changes.size(); ++i) {
        record::Record other = record;
        changes[i](other.ticks[2300]);
        const auto replayed = replay(other, std::nullopt);
        ASSERT_TRUE(replayed.has_value());
        EXPECT_EQ(replayed->differs_from, std::optional<std::uint64_t>{2300}) << i;
    }
}

TEST(ReplayOfARecord, GivesTheRecordedForcesByTheNameOfTheRecordedAlgorithm)
{
    const record::Record record = RecordedPair{}.play(2500);
    const auto own = peer::parse_algorithm(record.config["algorithm_toml"].get<std::string>(), "");
    const auto replayed = replay(record, own.value());
    ASSERT_TRUE(replayed.has_value());
    EXPECT_FALSE(replayed->is_the_recorded_one);
    EXPECT_EQ(replayed->contact_difference_max_n, 0.0);
    EXPECT_EQ(replayed->device_difference_max_n, 0.0);
}

TEST(ReplayOfARecord, TellsWhatAnotherAlgorithmWouldHaveMadeOfTheSameMessages)
{
    const auto other =
        peer::parse_algorithm("algorithm = \"base\"\nremote_force_on = \"body-and-hand\"", "other")
            .value();
    const auto replayed = replay(RecordedPair{}.play(4000), other);
    ASSERT_TRUE(replayed.has_value());
    EXPECT_EQ(replayed->algorithm, "base");
    EXPECT_FALSE(replayed->is_the_recorded_one);
    EXPECT_GT(replayed->contact_difference_max_n, 0.1);
}

TEST(ReplayOfARecord, NamesTheKeyThatTheConfigurationLacks)
{
    const record::Record whole = RecordedPair{}.play(10);
    for (const auto& [key, value] : whole.config.items()) {
        record::Record record = whole;
        if (key == "stiffness_max_n_per_m") continue; // which older records have not
        record.config.erase(key);
        const auto replayed = replay(record, std::nullopt);
        ASSERT_FALSE(replayed.has_value()) << key;
        EXPECT_NE(replayed.error().message.find('"' + key + '"'), std::string::npos);
    }
}

} // namespace
} // namespace hapnet::lab
