// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/send_policy.hpp"

#include "proto/base/text.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>
#include <variant>

namespace hapnet::peer {

namespace {

constexpr std::string_view forms = "write every:N with N from 1 to 50 ticks, or deadband:P% with P "
                                   "from 0 to 100, which may be followed by the longest silence: "
                                   "deadband:8%,100ms";
constexpr std::string_view every_word = "every:";
constexpr std::string_view deadband_word = "deadband:";

base::Error unknown(std::string_view text)
{
    return {fmt::format("'{}' is no way of sending: {}", text, forms)};
}

base::Result<SendPolicy> parse_every(std::string_view text, std::string_view whole)
{
    const auto ticks = base::parse_count(text, SendPolicy::every_max);
    if (!ticks || *ticks == 0) return tl::unexpected{unknown(whole)};
    SendPolicy policy;
    policy.every = static_cast<std::uint32_t>(*ticks);
    return policy;
}

base::Result<SendPolicy> parse_deadband(std::string_view text, std::string_view whole)
{
    const auto comma = text.find(',');
    const auto share = base::parse_probability(text.substr(0, comma));
    if (!share) return tl::unexpected{unknown(whole)};
    SendPolicy policy;
    policy.deadband = *share;
    if (comma == std::string_view::npos) return policy;
    const auto silence = base::parse_duration(text.substr(comma + 1));
    if (!silence || *silence < SendPolicy::silence_least || *silence > SendPolicy::silence_most)
        return base::fail(fmt::format("'{}': the longest silence is from 1ms to 100ms", whole));
    policy.silence_max = *silence;
    return policy;
}

/// True if the error of the receivers' prediction exceeds both a share of the signal and the floor.
bool is_beyond(double error, double share, double signal, double floor)
{
    return error > std::max(share * signal, floor);
}

} // namespace

base::Result<SendPolicy> parse_send_policy(std::string_view text)
{
    if (text.starts_with(every_word)) return parse_every(text.substr(every_word.size()), text);
    if (text.starts_with(deadband_word))
        return parse_deadband(text.substr(deadband_word.size()), text);
    return tl::unexpected{unknown(text)};
}

std::string text_of(const SendPolicy& policy)
{
    if (!policy.deadband) return fmt::format("{}{}", every_word, policy.every);
    std::string text = fmt::format("{}{}", deadband_word, base::to_text(*policy.deadband));
    if (policy.silence_max != SendPolicy{}.silence_max)
        text += ',' + base::to_text(policy.silence_max);
    return text;
}

void SendPolicyFormat::read(const base::Node& node, SendPolicy& target,
                            base::Reading& reading) const
{
    const auto* const text = std::get_if<std::string>(&node.value);
    if (text == nullptr) return base::complain_of(node, describe(), reading);
    const auto policy = parse_send_policy(*text);
    if (!policy) return reading.complain(node.place, policy.error().message);
    target = *policy;
}

std::string SendPolicyFormat::print(const SendPolicy& policy) const
{
    return base::quoted(text_of(policy));
}

std::string SendPolicyFormat::describe() const
{
    return R"(`"every:N"` with N from 1 to 50 ticks, or `"deadband:P%"`, or )"
           R"(`"deadband:P%,T"` with the longest silence T from 1ms to 100ms)";
}

SendCause SendGate::judge(const wire::State& state, std::int64_t number)
{
    if (!policy_.deadband) {
        const bool is_due = policy_.every == 1 || number % policy_.every == 0;
        return is_due ? SendCause::rate : SendCause::held_back;
    }
    const SendCause cause = last_ ? cause_against(*last_, state) : SendCause::silence;
    if (cause == SendCause::held_back) return cause;
    last_ = {.at = state.sent,
             .hip = state.hip,
             .velocity = state.hip_velocity,
             .force = state.contact_force,
             .touching = state.touching,
             .holding = state.holding};
    return cause;
}

SendCause SendGate::cause_against(const Sent& last, const wire::State& state) const
{
    if (state.touching != last.touching || state.holding != last.holding) return SendCause::contact;
    const double share = policy_.deadband->fraction();
    const base::Duration silence = state.sent - last.at;
    const base::Displacement predicted_way = last.velocity * silence;
    if (is_beyond(base::norm(state.contact_force - last.force), share, base::norm(last.force),
                  force_floor_n))
        return SendCause::force;
    if (is_beyond(base::norm(state.hip_velocity - last.velocity), share, base::norm(last.velocity),
                  velocity_floor_m_per_s))
        return SendCause::velocity;
    if (is_beyond(base::norm(state.hip - (last.hip + predicted_way)), share,
                  base::norm(predicted_way), position_floor_m))
        return SendCause::position;
    return silence >= policy_.silence_max ? SendCause::silence : SendCause::held_back;
}

} // namespace hapnet::peer
