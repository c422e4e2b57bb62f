// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/soak/round_judge.hpp"

#include "device/governor.hpp"
#include "proto/wire/message.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace hapnet::soak {
namespace {

using namespace std::chrono_literals;
using device::GovernorState;

constexpr base::TimePoint begin{1h};
constexpr double push_n = 0.5;

/// A record of peer 1, tick by tick, as a daemon writes it when all goes well: peer 2 pushes all
/// the time, peer 3 until it dies 1 s after the begin and again from 3 s on, as a new run.
class Written {
public:
    Written()
    {
        record.config = {{"peer_id", 1}, {"force_limit_n", 3.3}};
        add_session(2, 12);
        add_session(3, 13);
        for (int ms = 0; ms < 4000; ++ms) add_tick(ms);
    }

    /// The row at that time.
    [[nodiscard]] record::TickRow& at(std::size_t ms) { return record.ticks.at(ms); }
    [[nodiscard]] std::vector<std::string> breaches() const { return judge(record)->breaches; }

    record::Record record;

private:
    void add_session(std::uint16_t other, std::uint32_t session)
    {
        record.sessions.push_back({.session = session, .other = other});
    }
    void add_state(int ms, std::uint16_t from, std::uint32_t session)
    {
        wire::State state;
        state.session = session;
        state.sequence = static_cast<std::uint32_t>(ms + 1);
        state.sent = begin + ms * 1ms;
        state.touching = true;
        state.contact_force = {{push_n, 0.0, 0.0}};
        wire::BodyState body;
        body.position = {{1e-3 * from, 0.0, 0.0}};
        state.bodies.add(body);
        const wire::Datagram sent = wire::encode(state);
        record.messages.push_back({.tick = static_cast<std::uint64_t>(ms),
                                   .received_at = state.sent,
                                   .from = from,
                                   .bytes = {sent.bytes().begin(), sent.bytes().end()}});
    }
    void add_tick(int ms)
    {
        add_state(ms, 2, 12);
        if (ms == 3000) add_session(3, 33);
        if (ms < 1000) add_state(ms, 3, 13);
        if (ms >= 3000) add_state(ms, 3, 33);
        const int silent_ms = ms < 1000 || ms >= 3000 ? 0 : ms - 999;
        const double fresh = std::clamp(1.0 - (silent_ms - 250) / 50.0, 0.0, 1.0);
        const bool is_permitted = silent_ms < 300 || silent_ms > 1050;
        record::TickRow row;
        row.tick = static_cast<std::uint64_t>(ms);
        row.due = begin + ms * 1ms;
        row.phase = record::Phase::running;
        row.remote = {{push_n + fresh * push_n, 0.0, 0.0}};
        row.device = is_permitted ? base::Force{{-0.2, 0.0, 0.0}} : base::Force{};
        row.governor =
            static_cast<std::uint8_t>(is_permitted ? GovernorState::active : GovernorState::ready);
        record.ticks.push_back(row);
    }
};

TEST(RoundJudge, FindsNothingWhereTheDeadHandIsGoneInTime)
{
    Written written;
    const auto verdict = judge(written.record);
    ASSERT_TRUE(verdict);
    EXPECT_TRUE(verdict->breaches.empty()) << verdict->breaches.front();
    EXPECT_EQ(verdict->silences, 1U);
    EXPECT_EQ(verdict->died_touching, 1U);
    EXPECT_EQ(verdict->counted_max_ms, 299.0);
    EXPECT_EQ(verdict->felt_max_ms, 299.0);
    EXPECT_EQ(verdict->lasted, 1U);
    EXPECT_EQ(verdict->played_on, 1U);
    EXPECT_EQ(verdict->force_max_n, 0.2);
    EXPECT_NEAR(verdict->hands_on_s, 4.0, 1e-9);
}

TEST(RoundJudge, FindsADeadHandThatStillPushes)
{
    Written written;
    written.at(1310).remote = {{2.0 * push_n, 0.0, 0.0}}; // 311 ms after its last state
    EXPECT_EQ(written.breaches().size(), 1U);
    Written in_time;
    in_time.at(1298).remote = {{2.0 * push_n, 0.0, 0.0}};
    EXPECT_TRUE(in_time.breaches().empty());
}

TEST(RoundJudge, FindsAForceBesideOneThatDiedTouching)
{
    Written written;
    written.at(1500).device = {{0.01, 0.0, 0.0}};
    EXPECT_EQ(written.breaches().size(), 1U);
}

TEST(RoundJudge, FindsOneThatDoesNotPlayOn)
{
    Written written;
    for (std::size_t ms = 2000; ms < 3000; ++ms)
        written.at(ms).governor = static_cast<std::uint8_t>(GovernorState::ready);
    EXPECT_EQ(written.breaches().size(), 1U);
    // A machine that stood still is no breach: it has to end at zero force.
    for (std::size_t ms = 2000; ms < 3000; ++ms)
        written.at(ms).governor = static_cast<std::uint8_t>(GovernorState::fault);
    EXPECT_TRUE(written.breaches().empty());
    EXPECT_TRUE(judge(written.record)->was_at_fault);
}

TEST(RoundJudge, FindsForcesBeyondTheLimitAndSuchAsAreNone)
{
    Written strong, absurd;
    strong.at(10).device = {{3.31, 0.0, 0.0}};
    EXPECT_EQ(strong.breaches().size(), 1U);
    absurd.at(10).device = {{std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0}};
    EXPECT_EQ(absurd.breaches().size(), 1U);
}

TEST(RoundJudge, ComparesTheCopiesOfTheBodiesAfterHandsOff)
{
    Written written;
    Poses poses;
    add_poses(poses, written.record);
    EXPECT_EQ(apart(poses).copies, 0U); // the hands were never off
    for (record::TickRow& row : written.record.ticks) row.phase = record::Phase::hands_off;
    add_poses(poses, written.record);
    EXPECT_EQ(apart(poses).copies, 2U);
    EXPECT_NEAR(apart(poses).distance_mm, 1.0, 1e-3); // f32 on the wire
    poses[0][2].orientation = glm::dquat{1.0, 0.0, 0.0, 0.0};
    poses[0][3].orientation = glm::dquat{std::cos(0.01), std::sin(0.01), 0.0, 0.0};
    EXPECT_NEAR(apart(poses).angle_deg, glm::degrees(0.02), 1e-9);
}

TEST(RoundJudge, RefusesARecordThatDoesNotSayTheLimitOfItsForces) { EXPECT_FALSE(judge({})); }

} // namespace
} // namespace hapnet::soak
