// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/records/replay.hpp"

#include "peer/core/sync/text.hpp"
#include "proto/base/fields_json.hpp"
#include "proto/record/codec.hpp"
#include "tests/unit/lab/records/recorded_pair.hpp"

#include <algorithm>
#include <limits>

namespace hapnet::lab::records {
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

TEST(ReplayOfARecord, LimitsTheEnergyIntoTheHandAsTheRecordedGovernorDid)
{
    RecordedPair pair;
    pair.limit_energy({.power_max_w = 0.01, .work_max_j = 0.002});
    record::Record record = pair.play(4000);
    EXPECT_GT(pair.governor().counters().energy_limited, 100U);
    const auto replayed = replay(record, std::nullopt);
    ASSERT_TRUE(replayed.has_value()) << replayed.error().message;
    EXPECT_EQ(replayed->contact_difference_max_n, 0.0);
    EXPECT_EQ(replayed->device_difference_max_n, 0.0);
    record.config["governor_toml"] = device::print_limits(limits_of_recorded_pair());
    EXPECT_GT(replay(record, std::nullopt).value().device_difference_max_n, 0.1);
}

TEST(ReplayOfARecord, PutsEveryBodyWhereItWasAndNoticesOneThatWasNot)
{
    RecordedPair pair;
    pair.play_in(scene::load_scene("stack-of-three", {}).value());
    record::Record record = pair.play(3000);
    ASSERT_EQ(record.bodies.size(), 9000U);
    const auto replayed = replay(record, std::nullopt);
    ASSERT_TRUE(replayed.has_value()) << replayed.error().message;
    EXPECT_EQ(replayed->body_difference_max_m, 0.0);
    EXPECT_EQ(replayed->turn_difference_max_rad, 0.0);
    EXPECT_FALSE(replayed->differs_from);
    const auto json = base::json_of(*replayed);
    EXPECT_EQ(json["body_difference_max_mm"], 0.0);
    record.bodies[3 * 2000 + 1].position.value.x += 0.001;
    const auto other = replay(record, std::nullopt);
    EXPECT_EQ(other.value().differs_from, 2000U);
    EXPECT_NEAR(*other->body_difference_max_m, 0.001, 1e-12);
    EXPECT_FALSE(replay(RecordedPair{}.play(10), std::nullopt).value().body_difference_max_m);
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
            auto state = std::get<wire::State>(wire::decode(found->bytes).value());
            state.contact_force.value.x += 0.01;
            std::ranges::copy(wire::encode(state).bytes(), found->bytes.begin());
        }
        const auto replayed = replay(other, std::nullopt);
        ASSERT_TRUE(replayed.has_value());
        EXPECT_EQ(replayed->differs_from, std::optional<std::uint64_t>{2000}) << lost;
        EXPECT_EQ(base::json_of(*replayed)["reproduced"], false);
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
        if (key == "stiffness_max_n_per_m") continue; // older records lack it
        record.config.erase(key);
        const auto replayed = replay(record, std::nullopt);
        ASSERT_FALSE(replayed.has_value()) << key;
        EXPECT_NE(replayed.error().message.find('\'' + key + '\''), std::string::npos);
    }
}

TEST(ReplayOfARecord, RefusesNumbersThatNoPeerHas)
{
    const record::Record whole = RecordedPair{}.play(10);
    for (const char* key : {"nonce", "peer_id"}) {
        record::Record record = whole;
        record.config[key] = 0;
        const auto replayed = replay(record, std::nullopt);
        ASSERT_FALSE(replayed.has_value()) << key;
        EXPECT_NE(replayed.error().message.find(key), std::string::npos);
    }
}

// Records of sessions in which something went wrong, and damaged records.

using device::Fault;
using device::GovernorState;

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

/// A change that lasts from one tick until before another.
template <typename Change>
RecordedPair::Fate between(int first, int end, Change change)
{
    return [=](int tick, device::Sample& sample, device::Governor&) {
        if (tick >= first && tick < end) change(sample);
    };
}

bool was_ever(const record::Record& record, GovernorState state)
{
    return std::ranges::any_of(record.ticks, [&](const record::TickRow& row) {
        return row.governor == static_cast<std::uint8_t>(state);
    });
}

TEST(ReplayOfARecord, RefusesPeersThatCannotHavePlayed)
{
    record::Record record = RecordedPair{}.play(1500);
    record.config["peers"] = {0};
    EXPECT_TRUE(replay(record, std::nullopt).has_value());
    for (const auto& peers : {nlohmann::json{3, 2}, nlohmann::json{2, 2}, nlohmann::json{0, 2},
                              nlohmann::json::array(), nlohmann::json{2, 3, 4, 5, 6, 7, 8, 9}}) {
        record.config["peers"] = peers;
        const auto refused = replay(record, std::nullopt);
        ASSERT_FALSE(refused.has_value()) << peers;
        EXPECT_NE(refused.error().message.find("'peers'"), std::string::npos);
    }
    record.config["peers"] = {2, 3};
    EXPECT_EQ(replay(record, std::nullopt).error().message,
              "a message of peer 0, which is not of the session: the file is damaged");
    for (record::MessageRow& message : record.messages) message.from = 2;
    EXPECT_TRUE(replay(record, std::nullopt).has_value());
    EXPECT_FALSE(
        replay(record, peer::parse_algorithm("algorithm = \"sep\"", "test").value()).has_value());
}

TEST(ReplayOfATroubledSession, GivesTheForcesBeforeTheFaultAtItAndAfterIt)
{
    const std::vector<RecordedPair::Fate> fates{
        between(2300, 9999, [](auto& sample) { sample.fault = Fault::disconnected; }),
        between(2300, 2450, [](auto& sample) { sample.fault = Fault::timeout; }),
        between(2300, 2450, [](auto& sample) { sample.sequence = 2300; }),
        between(2300, 2310, [](auto& sample) { sample.hip.value.y = no_number; }),
        between(2300, 2301, [](auto& sample) { sample.velocity.value.z = 1.5; }),
        // A halt by the watchdog, which the device does not see.
        [](int tick, device::Sample&, device::Governor& governor) {
            if (tick == 2300) governor.latch({Fault::timeout, device::Trip::loop});
        },
    };
    for (std::size_t i = 0; i < fates.size(); ++i) {
        const record::Record record = RecordedPair{fates[i]}.play(2600);
        EXPECT_TRUE(was_ever(record, GovernorState::fault)) << i;
        EXPECT_GT(base::norm(record.ticks[2299].device), 0.2) << i;
        EXPECT_EQ(record.ticks[2599].device, base::Force{}) << i;
        const auto replayed = replay(record, std::nullopt);
        ASSERT_TRUE(replayed.has_value()) << i;
        EXPECT_EQ(replayed->device_difference_max_n, 0.0) << i << " " << *replayed->differs_from;
        EXPECT_EQ(replayed->contact_difference_max_n, 0.0) << i;
    }
}

TEST(ReplayOfATroubledSession, GivesTheForcesAfterAnOperatorHasEndedAFault)
{
    for (const bool watchdog : {true, false}) {
        RecordedPair pair{[=](int tick, device::Sample& sample, device::Governor& governor) {
            if (tick == 2300 && watchdog) {
                governor.latch({Fault::timeout, device::Trip::loop});
            } else if (tick == 2300) {
                sample.fault = Fault::communication;
            }
            sample.buttons = tick >= 3400 ? 1 : 0;
        }};
        const record::Record record = pair.play(4300);
        EXPECT_EQ(record.ticks[3699].device, base::Force{});
        EXPECT_GT(base::norm(record.ticks[4299].device), 0.1);
        const auto replayed = replay(record, std::nullopt);
        ASSERT_TRUE(replayed.has_value());
        EXPECT_EQ(replayed->device_difference_max_n, 0.0);
    }
}

TEST(ReplayOfATroubledSession, GivesTheForcesAfterAStallWhetherOrNotAWatchdogSawItFirst)
{
    for (const bool is_watchdog_first : {true, false}) {
        RecordedPair pair{[=](int tick, device::Sample& sample, device::Governor& governor) {
            if (tick == 2300 && is_watchdog_first) {
                governor.latch({Fault::timeout, device::Trip::loop});
            }
            sample.buttons = tick >= 3400 ? 1 : 0;
        }};
        pair.limit_energy({.power_max_w = 0.01, .work_max_j = 0.002});
        pair.stand_still(2300, std::chrono::milliseconds{150});
        const record::Record record = pair.play(6000);
        EXPECT_GT(base::norm(record.ticks[2299].device), 0.01);
        EXPECT_TRUE(was_ever(record, GovernorState::fault));
        EXPECT_GT(base::norm(record.ticks[5999].device), 0.0);
        const auto replayed = replay(record, std::nullopt);
        ASSERT_TRUE(replayed.has_value());
        EXPECT_EQ(replayed->contact_difference_max_n, 0.0);
        EXPECT_EQ(replayed->device_difference_max_n, 0.0);
    }
}

TEST(ReplayOfADamagedRecord, RefusesOneWithoutTicksOrWithTicksMissingOrOutOfOrder)
{
    const record::Record whole = RecordedPair{}.play(100);
    const auto refused = [](const record::Record& record) {
        const auto replayed = replay(record, std::nullopt);
        return replayed ? std::string{} : replayed.error().message;
    };
    record::Record record = whole;
    record.ticks.clear();
    EXPECT_EQ(refused(record), "it has no ticks");
    record = whole;
    record.ticks.erase(record.ticks.begin() + 40, record.ticks.begin() + 45);
    EXPECT_TRUE(refused(record).starts_with("ticks 40 to 44 are missing"));
    record = whole;
    std::swap(record.ticks[40], record.ticks[41]);
    EXPECT_TRUE(refused(record).starts_with("ticks 40 to 40 are missing"));
    record = whole;
    record.ticks[41].tick = 7;
    EXPECT_EQ(refused(record), "tick 7 follows where tick 41 is expected: the file is damaged");
    record = whole;
    record.ticks[41].late -= 2ms;
    EXPECT_EQ(refused(record), "tick 41 is not later than the tick before it: the file is damaged");
}

TEST(ReplayOfADamagedRecord, PlaysWhatIsLeftOfOneThatIsCutOffAndSaysThatItIsCutOff)
{
    record::Record record = RecordedPair{}.play(2500);
    const auto replayed = replay(record, std::nullopt);
    ASSERT_TRUE(replayed.has_value());
    EXPECT_FALSE(replayed->differs_from);
    EXPECT_FALSE(replayed->is_complete);
    EXPECT_EQ(base::json_of(*replayed)["complete"], false);
    EXPECT_NE(to_table(*replayed).find("stops before the session's end"), std::string::npos);

    record::TickRow end = record.ticks.back();
    ++end.tick;
    end.due += std::chrono::milliseconds{1};
    end.phase = record::Phase::ended;
    record.ticks.push_back(end);
    const auto ended = replay(record, std::nullopt);
    EXPECT_TRUE(ended.value().is_complete);
    EXPECT_EQ(to_table(*ended).find("stops before"), std::string::npos);
}

/// A record with one bit of one row flipped, as by a bad disk; nullopt where the row itself is
/// refused.
template <typename Row>
std::optional<Row> with_bit_flipped(const Row& row, std::size_t byte, unsigned bit)
{
    record::RowBytes bytes = record::encode(row);
    if (byte >= bytes.size()) return std::nullopt;
    bytes[byte] ^= std::byte{1} << bit;
    const auto decoded = record::decode(bytes);
    if (!decoded || !std::holds_alternative<Row>(*decoded)) return std::nullopt;
    return std::get<Row>(*decoded);
}

TEST(ReplayOfADamagedRecord, SurvivesEveryBitOfATickAndOfAMessage)
{
    const record::Record whole = RecordedPair{}.play(1300);
    const auto message = static_cast<std::size_t>(
        std::ranges::find(whole.messages, 1250U, &record::MessageRow::tick) -
        whole.messages.begin());
    ASSERT_LT(message, whole.messages.size());
    record::Record record = whole;
    int told = 0;
    const auto play = [&] {
        const auto replayed = replay(record, std::nullopt);
        if (!replayed || replayed->differs_from) ++told;
    };
    for (std::size_t byte = 1; byte < record::row_bytes; ++byte) {
        const unsigned bit = byte % 2 == 0 ? 7 : 4; // signs and exponents among them
        record = whole;
        if (const auto row = with_bit_flipped(whole.ticks[1250], byte, bit)) {
            record.ticks[1250] = *row;
            play();
        }
        record = whole;
        if (const auto row = with_bit_flipped(whole.messages[message], byte, bit)) {
            record.messages[message] = *row;
            play();
        }
    }
    // Not found is damage to values without effect on a force, such as the cube's place or the last
    // digits of a hand's place: 75 of 430 are found.
    EXPECT_GT(told, 60);
}

} // namespace
} // namespace hapnet::lab::records
