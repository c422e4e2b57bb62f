// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/names.hpp"
#include "proto/base/probability.hpp"
#include "proto/base/reading.hpp"
#include "proto/base/result.hpp"
#include "proto/base/space.hpp"
#include "proto/base/time.hpp"
#include "proto/wire/message.hpp"

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace hapnet::peer {

/// The rule by which a peer sends its state: every N ticks, or, with a deadband, when the others'
/// prediction from the last message is too inaccurate. This is a perceptual deadband as in P.
/// Hinterseer et al., Perception-based data reduction and transmission of haptic data in
/// telepresence and teleaction systems, IEEE Trans. Signal Processing 56 (2008), and IEEE 1918.1.1.
struct SendPolicy {
    static constexpr std::uint32_t every_max = 50; // ticks: 20 messages a second
    static constexpr base::Duration silence_least{std::chrono::milliseconds{1}};
    static constexpr base::Duration silence_most{std::chrono::milliseconds{100}};

    std::uint32_t every = 1;                   // ticks from one message to the next, 1 to every_max
    std::optional<base::Probability> deadband; // Weber's fraction; with it `every` is 1
    base::Duration silence_max{std::chrono::milliseconds{50}}; // longest pause with a deadband

    /// True if every tick has a message.
    [[nodiscard]] bool is_each_tick() const { return every == 1 && !deadband; }

    friend bool operator==(const SendPolicy&, const SendPolicy&) = default;
};

/// Parses "every:10", "deadband:8%", or "deadband:8%,100ms", where the time is the longest silence.
[[nodiscard]] base::Result<SendPolicy> parse_send_policy(std::string_view text);
[[nodiscard]] std::string text_of(const SendPolicy& policy);

/// The format of a send policy as a value in a text.
struct SendPolicyFormat {
    void read(const base::Node& node, SendPolicy& target, base::Reading& reading) const;
    [[nodiscard]] std::string print(const SendPolicy& policy) const;
    [[nodiscard]] std::string describe() const;
};

/// The reason why a tick has a message, or has none.
enum class SendCause : std::uint8_t {
    held_back,
    rate,
    contact,
    force,
    velocity,
    position,
    silence
};
constexpr auto names_of(base::Tag<SendCause> /*enum*/)
{
    return base::names("held_back", "rate", "contact", "force", "velocity", "position", "silence");
}

/// Decides in each tick if the state is due. It assumes that receivers predict a hand that
/// continues with the velocity of the last message, and a constant force.
class SendGate {
public:
    // The error of a prediction below which no message is sent, however small the signal is.
    static constexpr double position_floor_m = 0.1e-3;
    static constexpr double velocity_floor_m_per_s = 5e-3;
    static constexpr double force_floor_n = 0.02;

    explicit SendGate(const SendPolicy& policy) : policy_{policy} {}

    /// Returns why the state of this tick is due, or held_back when it is not. `number` is the
    /// number of the tick, from 0 in the session. The state must contain the hand, its force and
    /// its contacts. A state that is due counts as sent.
    [[nodiscard]] SendCause judge(const wire::State& state, std::int64_t number);

private:
    struct Sent {
        base::TimePoint at;
        base::Position hip;
        base::Velocity velocity;
        base::Force force;
        bool touching = false;
        bool holding = false;
    };
    [[nodiscard]] SendCause cause_against(const Sent& last, const wire::State& state) const;

    SendPolicy policy_;
    std::optional<Sent> last_;
};

} // namespace hapnet::peer
