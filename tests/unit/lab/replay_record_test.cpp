// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/core/replay.hpp"

#include "device/governor.hpp"
#include "device/governor/limits_text.hpp"
#include "peer/core/scene/text/text.hpp"
#include "peer/core/sync/text.hpp"
#include "tests/unit/peer/pair.hpp"

#include <algorithm>
#include <cmath>

namespace hapnet::lab {
namespace {

using namespace std::chrono_literals;

nlohmann::json config_of(const peer::Settings& settings)
{
    return {{"peer_id", settings.introduction.id},
            {"nonce", settings.introduction.nonce},
            {"seed", settings.introduction.seed},
            {"tick_ns", 1'000'000},
            {"duration_s", base::to_seconds(settings.length)},
            {"grip_damping_ns_per_m", settings.grip_damping_ns_per_m},
            {"task", "T3"},
            {"mount", {{"offset_m", {0.0, 0.0, 0.0}}, {"scale", 1.0}}},
            {"governor_toml", device::print_limits(device::GovernorLimits{})},
            {"scene_toml", scene::to_text(settings.scene)},
            {"algorithm_toml", peer::print_algorithm(settings.algorithm)}};
}

/// Two hands squeeze the cube and sway; side 0 keeps a record as its daemon does.
class RecordedPair {
public:
    /// The contact has 500 N/m, and its device renders so much; 0: all of it.
    explicit RecordedPair(double stiffness_max_n_per_m = 0.0)
    {
        peer::Settings settings = peer::settings_of(0);
        settings.stiffness_max_n_per_m = stiffness_max_n_per_m;
        pair_.start(0, settings);
        record_.config = config_of(settings);
        record_.config["stiffness_max_n_per_m"] = stiffness_max_n_per_m;
    }

    record::Record play(int ticks)
    {
        for (int i = 0; i < ticks; ++i) {
            const double sway = 0.004 * std::sin(0.01 * i);
            const base::Velocity speed{{0.04 * std::cos(0.01 * i), 0.0, 0.0}};
            pair_.hands[0] = peer::pushing(0.003 + sway);
            pair_.hands[0].velocity = speed;
            pair_.hands[1] = {.hip = {{0.022 + sway, 0.0, 0.0}}, .velocity = speed};
            note_messages(static_cast<std::uint64_t>(i));
            pair_.step();
            note_tick(static_cast<std::uint64_t>(i));
        }
        return record_;
    }

private:
    void note_messages(std::uint64_t tick)
    {
        for (const wire::Message& message : pair_.sent[1]) {
            const auto datagram = wire::encode(message);
            record::MessageRow row{.tick = tick,
                                   .received_at = pair_.now + 1ms,
                                   .size = static_cast<std::uint16_t>(datagram.bytes().size())};
            std::ranges::copy(datagram.bytes(), row.bytes.begin());
            record_.messages.push_back(row);
        }
    }

    void note_tick(std::uint64_t tick)
    {
        record::TickRow row;
        row.tick = tick;
        row.due = pair_.now;
        row.hip = pair_.hands[0].hip;
        row.hip_velocity = pair_.hands[0].velocity;
        row.sample_sequence = static_cast<std::uint16_t>(tick + 1);
        row.contact = pair_.ticks[0].force;
        device::Sample sample;
        sample.hip = row.hip;
        sample.velocity = row.hip_velocity;
        sample.sequence = tick + 1;
        row.device =
            governor_.govern({row.contact, pair_.ticks[0].permitted}, sample, pair_.now).force();
        record_.ticks.push_back(row);
    }

    peer::Pair pair_;
    device::Governor governor_{device::GovernorLimits{}};
    record::Record record_;
};

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
    record::Record record = RecordedPair{250.0}.play(4000);
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
    record::Record record = RecordedPair{}.play(4000);
    record.messages.erase(record.messages.begin() + 2000, record.messages.begin() + 2500);
    const auto replayed = replay(record, std::nullopt);
    ASSERT_TRUE(replayed.has_value());
    ASSERT_TRUE(replayed->differs_from);
    EXPECT_GT(*replayed->differs_from, 1900U);
    EXPECT_EQ(to_json(*replayed)["reproduced"], false);
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

TEST(ReplayOfARecord, RefusesARecordWithTicksMissing)
{
    record::Record record = RecordedPair{}.play(100);
    record.ticks.erase(record.ticks.begin() + 40, record.ticks.begin() + 45);
    const auto replayed = replay(record, std::nullopt);
    ASSERT_FALSE(replayed.has_value());
    EXPECT_TRUE(replayed.error().message.starts_with("its ticks 40 to 44 are missing"));
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
