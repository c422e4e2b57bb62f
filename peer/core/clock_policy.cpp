// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/clock_policy.hpp"

#include "proto/base/text.hpp"
#include "proto/wire/message.hpp"

#include <spdlog/fmt/fmt.h>
#include <variant>

namespace hapnet::peer {

namespace {

constexpr std::string_view echo_word = "echo";
constexpr std::string_view synchronised_word = "synchronised";

} // namespace

base::Result<ClockPolicy> parse_clock_policy(std::string_view text)
{
    if (text == echo_word) return ClockPolicy{};
    if (text == synchronised_word) return ClockPolicy{base::Duration{0}};
    const bool has_error = text.starts_with(synchronised_word) &&
                           text.substr(synchronised_word.size()).starts_with(':');
    if (has_error) {
        const auto error = base::parse_duration(text.substr(synchronised_word.size() + 1));
        if (error && *error >= base::Duration{0} && *error <= ClockPolicy::error_max)
            return ClockPolicy{*error};
    }
    return base::fail(fmt::format("'{}' is no clock: write echo, or synchronised, which an error "
                                  "of up to 1s may follow: synchronised:2ms",
                                  text));
}

std::string text_of(const ClockPolicy& policy)
{
    if (!policy.synchronised_within) return std::string{echo_word};
    return fmt::format("{}:{}", synchronised_word, base::to_text(*policy.synchronised_within));
}

std::uint32_t clock_hash(const ClockPolicy& policy, std::string_view boot_id)
{
    return wire::boot_of(policy.synchronised_within ? synchronised_word : boot_id);
}

void ClockPolicyFormat::read(const base::Node& node, ClockPolicy& target,
                             base::Reading& reading) const
{
    const auto* const text = std::get_if<std::string>(&node.value);
    if (text == nullptr) return base::complain_of(node, describe(), reading);
    const auto policy = parse_clock_policy(*text);
    if (!policy) return reading.complain(node.place, policy.error().message);
    target = *policy;
}

std::string ClockPolicyFormat::print(const ClockPolicy& policy) const
{
    return base::quoted(text_of(policy));
}

std::string ClockPolicyFormat::describe() const
{
    return R"(`"echo"`, `"synchronised"`, or `"synchronised:T"` with an error T of up to 1s)";
}

} // namespace hapnet::peer
