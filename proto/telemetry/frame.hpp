// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/describe.hpp"
#include "proto/base/space.hpp"
#include "proto/base/time.hpp"
#include "proto/base/value_kind.hpp"
#include "proto/record/rows.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace hapnet::telemetry {

// The frame of a peer, see docs/formats/live.md. Lengths, speeds and forces are in SI units.

// The numbers of decimals in JSON: for lengths, speeds and rotations; for forces; for milliseconds
// and microseconds.
inline constexpr int si_decimals = 9;
inline constexpr int force_decimals = 7;
inline constexpr int ms_decimals = 4;
inline constexpr int us_decimals = 3;

/// The minimum, the maximum and the mean of some values. All are 0 before the first value.
class Spread {
public:
    void add(double value)
    {
        min_ = count_ == 0 ? value : std::min(min_, value);
        max_ = count_ == 0 ? value : std::max(max_, value);
        sum_ += value;
        ++count_;
    }

    [[nodiscard]] bool empty() const { return count_ == 0; }
    [[nodiscard]] std::uint64_t count() const { return count_; }
    /// Returns 0 while there is no value.
    [[nodiscard]] double min() const { return min_; }
    [[nodiscard]] double max() const { return max_; }
    [[nodiscard]] double mean() const
    {
        return count_ == 0 ? 0.0 : sum_ / static_cast<double>(count_);
    }

private:
    double min_ = 0.0;
    double max_ = 0.0;
    double sum_ = 0.0;
    std::uint64_t count_ = 0;
};

constexpr auto fields_of(base::Tag<Spread>)
{
    using S = Spread;
    return base::fields("spread",
                        base::computed<S>("min", [](const S& spread) { return spread.min(); }),
                        base::computed<S>("mean", [](const S& spread) { return spread.mean(); }),
                        base::computed<S>("max", [](const S& spread) { return spread.max(); }));
}

/// The maximum of some values.
struct Largest {
    double max = 0.0;
};
constexpr auto fields_of(base::Tag<Largest>)
{
    return base::fields("largest", base::member("max", &Largest::max));
}

/// The minimum and the maximum of some values.
struct Range {
    double min = 0.0;
    double max = 0.0;
};
constexpr auto fields_of(base::Tag<Range>)
{
    return base::fields("range", base::member("min", &Range::min),
                        base::member("max", &Range::max));
}

/// Returns a vector as a list for JSON.
[[nodiscard]] inline std::array<double, 3> list_of(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

/// Figures about another peer's messages. Counts and `delay_ms` cover the time since the last
/// frame.
struct HeardFrame {
    std::uint16_t from = 0;
    std::uint64_t messages = 0;           // states that arrived
    std::uint64_t lost = 0;               // gaps in the numbers of states
    std::uint64_t late = 0;               // states that arrived after a higher number, or again
    Spread delay_ms;                      // sender's stamp to this kernel's stamp
    std::optional<base::Duration> age;    // age of the newest state at the frame's time
    std::optional<base::Duration> offset; // the other peer's clock minus this one
    std::optional<base::Duration> offset_uncertainty;
};

constexpr auto fields_of(base::Tag<HeardFrame>)
{
    using H = HeardFrame;
    return base::fields(
        "heard", base::member("from", &H::from, "Its id."),
        base::member("n", &H::messages, "States that arrived since the frame before."),
        base::member("lost", &H::lost,
                     "Likewise gaps in the sequence, counted when a higher number comes."),
        base::member("late", &H::late, "Likewise states that came after a higher one."),
        base::computed<H>(
            "delay_ms",
            [](const H& heard) { return heard.delay_ms.empty() ? nullptr : &heard.delay_ms; },
            "From the sender's stamp to this kernel's receive stamp; null without messages or "
            "before the clocks are compared.")
            .rounded(ms_decimals),
        base::member("age_ms", &H::age, "The age of the newest state at `at_ns`.")
            .rounded(ms_decimals),
        base::member("offset_ms", &H::offset, "Its clock against this one.").rounded(ms_decimals),
        base::member("uncertainty_ms", &H::offset_uncertainty, "The uncertainty of that.")
            .rounded(ms_decimals));
}

/// The position of a shared body, in sessions whose ticks do not contain it.
struct BodyFrame {
    std::uint16_t body = 0;
    base::Position position;
    base::Velocity velocity;
    glm::dquat orientation{1.0, 0.0, 0.0, 0.0};
};

constexpr auto fields_of(base::Tag<BodyFrame>)
{
    using B = BodyFrame;
    return base::fields(
        "body", base::member("body", &B::body, "Its number in the scene."),
        base::computed<B>(
            "position", [](const B& body) { return list_of(body.position.value); }, "Where it is.")
            .rounded(si_decimals),
        base::computed<B>(
            "velocity", [](const B& body) { return list_of(body.velocity.value); }, "How it moves.")
            .rounded(si_decimals),
        base::computed<B>(
            "orientation",
            [](const B& body) {
                const glm::dquat& q = body.orientation;
                return std::array{q.w, q.x, q.y, q.z};
            },
            "A quaternion, w before x, y and z.")
            .rounded(si_decimals));
}

/// Data about the session in a frame.
struct SessionFrame {
    std::uint32_t number = 0;
    base::Duration at{};
    record::Phase phase = record::Phase::waiting;
};
constexpr auto fields_of(base::Tag<SessionFrame>)
{
    return base::fields(
        "session", base::member("number", &SessionFrame::number, "Its number."),
        base::member("at_s", &SessionFrame::at, "Negative before its start.").rounded(ms_decimals),
        base::member("phase", &SessionFrame::phase, "As in `phase` of the frame."));
}

/// The newest tick of a peer in a frame.
struct TickFrame {
    record::TickRow row;
};
constexpr auto fields_of(base::Tag<TickFrame>)
{
    using T = TickFrame;
    return base::fields(
        "tick",
        base::computed<T>(
            "hip", [](const T& frame) { return list_of(frame.row.hip.value); },
            "The place of the hand.")
            .rounded(si_decimals),
        base::computed<T>(
            "hip_v", [](const T& frame) { return list_of(frame.row.hip_velocity.value); },
            "Its velocity.")
            .rounded(si_decimals),
        base::computed<T>(
            "cube", [](const T& frame) { return list_of(frame.row.cube.value); },
            "The place of the first shared body.")
            .rounded(si_decimals),
        base::computed<T>(
            "cube_v", [](const T& frame) { return list_of(frame.row.cube_velocity.value); },
            "Its velocity.")
            .rounded(si_decimals),
        base::computed<T>(
            "hand_force", [](const T& frame) { return list_of(frame.row.device.value); },
            "What the device was told, after the governor.")
            .rounded(force_decimals),
        base::computed<T>(
            "body_force", [](const T& frame) { return list_of(frame.row.contact.value); },
            "What the scene exerts on the hand, before it.")
            .rounded(force_decimals),
        base::computed<T>(
            "remote_force", [](const T& frame) { return list_of(frame.row.remote.value); },
            "That of the other side as this tick used it.")
            .rounded(force_decimals),
        base::computed<T>(
            "touching", [](const T& frame) { return frame.row.touching; },
            "Whether the hand touches the body."),
        base::computed<T>(
            "remote_touching", [](const T& frame) { return frame.row.remote_touching; },
            "Whether another hand does."),
        base::computed<T>(
            "remote_fresh", [](const T& frame) { return frame.row.remote_fresh; },
            "Whether the state of the other side is young enough to be used."));
}

/// The newest state of a peer, and the extremes since the previous frame.
struct Frame {
    std::uint64_t number = 0;
    std::optional<std::uint64_t> left_out; // frames before this one that were not sent
    std::uint16_t peer = 0;
    TickFrame newest;
    std::optional<record::SessionRow> session;
    Spread cube_x_m;
    Spread force_n; // norm of the force that was sent to the device
    Spread late_us;
    std::uint64_t missed = 0;
    std::vector<BodyFrame> bodies;
    std::vector<HeardFrame> heard;
    std::string_view governor;             // name of the governor's state
    std::optional<std::string_view> fault; // nullopt: none

    [[nodiscard]] std::optional<SessionFrame> session_now() const
    {
        if (!session) return std::nullopt;
        return SessionFrame{session->session, newest.row.at() - session->start, newest.row.phase};
    }
};
constexpr auto fields_of(base::Tag<Frame>)
{
    using F = Frame;
    return base::fields(
        "frame",
        base::computed<F>(
            "ok", [](const F&) { return true; }, "Always true."),
        base::member("frame", &F::number, "Its number, from 0."),
        base::computed<F>(
            "at_ns",
            [](const F& frame) { return frame.newest.row.at().time_since_epoch().count(); },
            "When the device was read in the newest tick, CLOCK_BOOTTIME; positions, velocities "
            "and "
            "forces hold then."),
        base::member("peer", &F::peer, "The id of the peer."),
        base::computed<F>(
            "tick", [](const F& frame) { return frame.newest.row.tick; },
            "The newest tick, from 0."),
        base::computed<F>(
            "session", [](const F& frame) { return frame.session_now(); },
            "null before one is agreed."),
        base::computed<F>(
            "phase", [](const F& frame) { return frame.newest.row.phase; },
            "The phase as in `show`; it exists without a session, too."),
        base::part(&F::newest),
        base::computed<F>(
            "cube_x",
            [](const F& frame) {
                return Range{frame.cube_x_m.min(), frame.cube_x_m.max()};
            },
            "x of `cube` since the frame before.")
            .rounded(si_decimals),
        base::computed<F>(
            "force_n", [](const F& frame) { return Largest{frame.force_n.max()}; },
            "The largest norm of `hand_force`, likewise.")
            .rounded(force_decimals),
        base::computed<F>(
            "late_us", [](const F& frame) { return Largest{frame.late_us.max()}; },
            "How late the loop woke at most, likewise.")
            .rounded(us_decimals),
        base::computed<F>(
            "ticks", [](const F& frame) { return frame.late_us.count(); },
            "Ticks since the frame before."),
        base::member("missed", &F::missed, "Ticks skipped, likewise."),
        base::member("bodies", &F::bodies,
                     "The shared bodies, in sessions that share several, or one that turns.")
            .left_out_if_none(),
        base::member("heard", &F::heard,
                     "An entry for each other peer that was heard since the start."),
        base::member("governor", &F::governor, "The state of the governor."),
        base::member("fault", &F::fault, "The fault of the device; null without one."),
        base::member("left_out", &F::left_out,
                     "Frames that were due since the one before, and were not sent.")
            .left_out_if_none());
}

} // namespace hapnet::telemetry
