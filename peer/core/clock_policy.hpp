// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/reading.hpp"
#include "proto/base/result.hpp"
#include "proto/base/time.hpp"

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace hapnet::peer {

/// The source of a peer's knowledge about the others' clocks. Echoes cannot tell a longer way there
/// from a longer way back, so half of a path's asymmetry looks like an offset of the clocks. Hosts
/// whose clocks follow one source (NTP, PTP) need no estimate.
struct ClockPolicy {
    static constexpr base::Duration error_max{std::chrono::seconds{1}};

    /// The largest error of this host's clock; nullopt: clocks are compared by echoes alone.
    std::optional<base::Duration> synchronised_within{};

    friend bool operator==(const ClockPolicy&, const ClockPolicy&) = default;
};

/// Parses "echo", "synchronised", where the error is 0, or "synchronised:2ms" with an error of up
/// to 1 s.
[[nodiscard]] base::Result<ClockPolicy> parse_clock_policy(std::string_view text);
[[nodiscard]] std::string text_of(const ClockPolicy& policy);

/// Returns the number by which two peers recognise that they share a clock: a hash of the boot id,
/// or the same for all synchronised clocks. 0: unknown.
[[nodiscard]] std::uint32_t clock_hash(const ClockPolicy& policy, std::string_view boot_id);

/// The format of a clock policy as a value in a text.
struct ClockPolicyFormat {
    void read(const base::Node& node, ClockPolicy& target, base::Reading& reading) const;
    [[nodiscard]] std::string print(const ClockPolicy& policy) const;
    [[nodiscard]] std::string describe() const;
};

} // namespace hapnet::peer
