// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace hapnet::secure {

/// Recognises new initiations of the other side by their dates. A date is final once the other side
/// has used the key of its handshake: older dates are refused from then on. An unconfirmed date may
/// be that of a recorded initiation of an earlier run, and the other side's clock may have been set
/// back since. So older dates of any run are refused for a while, and afterwards only those of the
/// same run. Each recorded initiation is thus accepted once, and excludes the present run for that
/// while at most.
class InitiationDates {
public:
    /// The time for which an unconfirmed date also excludes other runs. An initiator waits for its
    /// key equally long.
    static constexpr base::Duration unconfirmed_lasts{std::chrono::seconds{5}};
    /// The number of runs whose unconfirmed dates are remembered. Beyond it, the one that was
    /// accepted longest ago is forgotten.
    static constexpr std::size_t runs_max = 32;

    /// Remembers a date, in ns since 1970, if it is new. Returns true if it was new. `run` is the
    /// run of the sender and never 0. Call it only if the initiation is proven to be from the other
    /// side.
    [[nodiscard]] bool take(std::uint32_t run, std::int64_t date, base::TimePoint now)
    {
        if (confirmed_ && date <= *confirmed_) return false;
        for (const Taken& taken : taken_) {
            const bool counts = taken.run == run || now - taken.at < unconfirmed_lasts;
            if (taken.run != 0 && counts && date <= taken.date) return false;
        }
        place_of(run) = {run, date, now};
        return true;
    }
    /// Makes the date of an initiation final, because the other side has used its key.
    void confirm(std::int64_t date) { confirmed_ = std::max(date, confirmed_.value_or(date)); }

private:
    struct Taken {
        std::uint32_t run = 0; // 0: unused
        std::int64_t date = 0; // newest date of that run
        base::TimePoint at;
    };

    [[nodiscard]] Taken& place_of(std::uint32_t run)
    {
        const auto same = std::ranges::find(taken_, run, &Taken::run);
        if (same != taken_.end()) return *same;
        const auto unused = std::ranges::find(taken_, std::uint32_t{0}, &Taken::run);
        if (unused != taken_.end()) return *unused;
        return *std::ranges::min_element(taken_, {}, &Taken::at);
    }

    std::optional<std::int64_t> confirmed_;
    std::array<Taken, runs_max> taken_{};
};

} // namespace hapnet::secure
