// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/sleep_policy.hpp"
#include "emulator/options.hpp"
#include "proto/base/time.hpp"
#include "proto/net/warm_up.hpp"

#include <optional>
#include <span>
#include <string_view>

namespace hapnet::emulator {

/// The warning about the risks of `spin`.
inline constexpr std::string_view spin_warning =
    "--timing spin may take a whole core. When another program needs that core, the kernel stops "
    "the emulator for about 50 ms in each second: give it a core of its own, or use precise";

/// Waits for datagrams and deadlines as SleepPolicy decides.
class Pacer {
public:
    Pacer(Timing timing, base::TimePoint now);

    /// Waits until a descriptor becomes readable or `deadline` comes. Returns at once shortly
    /// before `deadline`, so that the caller can watch the clock.
    void wait(std::span<const int> descriptors, std::optional<base::TimePoint> deadline);

private:
    SleepPolicy policy_;
    net::WarmUp warm_up_;
};

} // namespace hapnet::emulator
